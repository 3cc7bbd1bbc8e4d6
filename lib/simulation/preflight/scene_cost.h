// What a scene's terms cost, measured, and which of them it could do without at the accuracy that it asks for: by its
// linear static response under all loads at their peaks.
#pragma once

#include <string>
#include <vector>

#include "lib/simulation/run/setup.h"

namespace orthodyn {

struct TermCost {
  std::string name;
  double force = 0, tangent = 0;  // s, of one evaluation
};

// Of all terms at the initial state; takes about `seconds` in all.
std::vector<TermCost> term_costs(const FemModel& model, const State& initial, double seconds);

// One sentence each; none where nothing responds or the body is not held.
std::vector<std::string> dispensable(const Setup& setup, const std::vector<TermCost>& costs);

// The accuracy that it is judged by: integrator.rtol, or else 1e-3.
double accuracy_asked_for(const Scene& scene);

}  // namespace orthodyn
