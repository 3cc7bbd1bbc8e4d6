// What a short look at a model tells before it is integrated, and what follows from it for the choice of a method.
//
// Two eigenvalue bounds, one tangent and one symbolic analysis: counts, not clocks, so that the same scene always
// gets the same advice.
#pragma once

#include <optional>
#include <string>

#include "lib/ode/integrator.h"

namespace orthodyn {

struct Outlook {
  double damping_ratio = 0;                // of the motion itself, by stiffness-proportional damping everywhere
  double explicit_steps = 0;               // of central differences to the end, at the critical step; infinite if it
                                           // cannot be told
  double swings = 0;                       // radians of the motion, about, over the time span
  double solve_cost = 0, factor_cost = 0;  // in forces
};

// `linear_solver` is one of n x n matrices.
Outlook look_at(const Model& model, const Task& task, const Scales& scales, const std::string& linear_solver);

struct Advice {
  std::string method, because;   // no colon in the latter: it becomes a value of the input
  std::optional<double> safety = {};  // of central_differences
};

// No explicit method that would need more than `most_explicit_steps`.
Advice advise(const Outlook& look, double rtol, double most_explicit_steps);

}  // namespace orthodyn
