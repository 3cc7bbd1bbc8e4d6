// Whether the constraints of a model's joints are independent, and starts that satisfy them.
#pragma once

#include <string>
#include <vector>

namespace orthodyn {

class FemModel;
struct State;

// Makes a start satisfy the constraints of the model's joints: takes the least change of the velocities by the kinetic
// energy, and computes the multipliers. Returns the largest change of a velocity, m/s. Throws ConfigError, with the
// name of a joint, if points of joints are apart or if constraints depend on each other.
double start_consistently(const FemModel& model, State& state);

// The joints that keep a mechanism from moving on from a state: their constraints depend on each other there, or
// nearly so, as at the end of the range of a linkage. Empty if constraints are independent.
std::vector<std::string> joints_at_their_end(const FemModel& model, const State& state);

}  // namespace orthodyn
