// What integrating a model would cost by an explicit and by an implicit method, and the method that follows from it.
//
// Estimated from two eigenvalue bounds, one tangent and one symbolic analysis: counts, not clocks, so that the same
// scene always gets the same method; of several ranks all take what the first one finds (one process alone may take
// modes). Costs are in evaluations of
// the force. No function keeps a state: they may be called by several threads.
#pragma once

#include <optional>
#include <string>

#include "lib/ode/integrator.h"

namespace orthodyn {

struct CostEstimate {
  double damping_ratio = 0;                // of the motion itself, by stiffness-proportional damping in every region
  double explicit_steps = 0;               // of central differences at the critical step; infinite if it has none
  double phase = 0;                        // rad, by which the motion goes on over the time span, about
  double known_phase = 0;                  // the same where the motion's frequency is known; 0 where it is not
  double solve_cost = 0, factor_cost = 0;  // of an implicit step's solve and factorisation, in forces
  bool has_factor = true;                  // false where an iterative method solves
  bool smooth = true;                      // no contact
  bool driven = false;                     // loads or supports vary in time
};

// At task.initial, by which the model's stiffness is that of the whole run. `linear_solver` is one of n x n matrices
// (SolverPaths::reduced). Throws ConfigError if it does not take the model's matrices.
CostEstimate estimate_cost(const Model& model, const Task& task, const Scales& scales,
                           const SolverChoice& linear_solver);

struct MethodChoice {
  std::string method, rationale;      // no colon in the latter: it becomes a value of the input
  std::optional<double> safety = {};  // of central_differences
  std::optional<int> modes = {};      // of modal
  double cost = 0;                    // of the run, in forces, about; 0 of a method that the user has chosen
};

// The cheapest method for a local error of rtol. No explicit one that would need more than `most_explicit_steps`.
MethodChoice choose_method(const CostEstimate& cost, double rtol, double most_explicit_steps);

// The share s of the critical step h_c at which the errors of central differences are those of other methods at this
// rtol: in the phase at the end, phase (s omega h_c)^2 / 24 = 10 rtol, and in the energy of the fastest vibrations,
// s^2 = 100 rtol; at most 0.9. omega h_c is phase / explicit_steps; the phase is the known one where that is larger.
double safety_of_central_differences(const CostEstimate& cost, double rtol);

}  // namespace orthodyn
