// Estimates the cost of a run by an explicit and by an implicit method, and chooses a method. The unit of cost is one
// force evaluation.
//
// The estimate needs two eigenvalue bounds, one tangent and one symbolic analysis. It counts operations, with constants
// that were measured once, and measures no time itself, so a scene always gets the same method. All ranks use the first
// rank's estimate. Thread-safe.
#pragma once

#include <optional>
#include <string>

#include "lib/ode/integrator.h"

namespace orthodyn {

struct CostEstimate {
  double damping_ratio = 0;   // of the motion; 0 unless every region has stiffness-proportional damping
  double explicit_steps = 0;  // steps of central differences at the critical step; infinite if that step is unknown
  double phase = 0;           // estimated phase of the motion over the time span, rad
  double known_phase = 0;     // phase from a known frequency of the motion, rad; 0 if unknown
  double solve_cost = 0, factor_cost = 0;  // of one solve and of one factorisation of an implicit method
  bool has_factor = true;                  // false with an iterative linear solver; factor_cost is then its set-up
  bool smooth = true;                      // no contact
  bool driven = false;                     // loads or supports vary in time
};

// Uses the stiffness at task.initial for the whole run. `linear_solver`: one of
// linear_solver_names(SolverPaths::reduced). Throws ConfigError if this solver does not accept the model's matrices.
CostEstimate estimate_cost(const Model& model, const Task& task, const Scales& scales,
                           const SolverChoice& linear_solver);

struct MethodChoice {
  std::string method, rationale;      // the rationale contains no colon, because it becomes a YAML value
  std::optional<double> safety = {};  // step / critical step of central_differences; else empty
  std::optional<int> modes = {};      // number of modes of modal; else empty
  double cost = 0;                    // estimated cost of the run; 0 if the user has chosen the method
};

// Chooses the method for a local error of rtol. Central differences are chosen if they cost less than an implicit
// method and need fewer than `most_explicit_steps` steps. Otherwise the implicit method is chosen by the damping ratio,
// rtol and the phase error of a method of order 2.
MethodChoice choose_method(const CostEstimate& cost, double rtol, double most_explicit_steps);

// The largest share s <= 0.9 of the critical step h_c at which central differences are as accurate as other methods at
// this rtol. Two errors limit s: the phase error at the end, phi (s omega h_c)^2 / 24 <= 10 rtol, and the energy error
// of the fastest vibrations, s^2 <= 100 rtol. Here phi = max(phase, known_phase), and omega h_c = phi / explicit_steps.
double safety_of_central_differences(const CostEstimate& cost, double rtol);

}  // namespace orthodyn
