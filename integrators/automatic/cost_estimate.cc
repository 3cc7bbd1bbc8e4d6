#include "integrators/automatic/cost_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "integrators/damping_ratio.h"
#include "integrators/newton_matrix.h"
#include "lib/core/errors.h"
#include "lib/linear/solver_cost.h"

namespace orthodyn {

namespace {

// Measured: a force takes about 2.2 ns per entry of the tangent's lower triangle; a tangent takes as long as five
// forces.
constexpr double kForce = 2.2, kTangent = 5;

// kPhaseError: error of tr_bdf2 per radian of the oscillation q'' = -omega^2 q, relative to the amplitude, at rtol 1e-3
// with the amplitude as position scale. It was measured at rtol 1e-2 to 1e-5 over 10 to 100 rad and is proportional to
// rtol^(2/3). An error of up to kMostPhaseError times rtol is accepted.
constexpr double kPhaseError = 1.2e-3, kMostPhaseError = 20;

double phase_error_of_order_two(const CostEstimate& cost, double rtol) {
  if (!cost.smooth) return 0;
  const double decay = cost.damping_ratio * cost.known_phase;
  const double phase = decay > 1 ? 1 / cost.damping_ratio : cost.known_phase;  // decay > 1: decayed before the end
  return kPhaseError * phase * std::pow(rtol / 1e-3, 2.0 / 3);
}

// Measured with an L-stable method of order two at rtol 1e-3: steps per radian of the motion, Newton iterations per
// step, tangents and factorisations per step.
constexpr double kSteps = 7, kIterations = 4, kTangents = 0.3;

// Number of steps that a method of this order needs for a phase (rad).
double steps_for(double phase, double rtol, double order = 2) {
  return 10 + kSteps * phase * std::pow(1e-3 / rtol, 1 / (order + 1));
}

// Phase (rad) until the motion has decayed, or of the whole run if loads drive the motion.
double moving_phase(const CostEstimate& cost) {
  constexpr double kDecays = 5;
  const double phase = std::max(cost.phase, cost.known_phase);
  return cost.damping_ratio > 0 && !cost.driven ? std::min(phase, kDecays / cost.damping_ratio) : phase;
}

double cost_of_implicit_step(const CostEstimate& cost) {
  return kIterations * (1 + cost.solve_cost) + kTangents * (kTangent + cost.factor_cost);
}

CostEstimate estimate_here(const Model& model, const Task& task, const Scales& scales,
                           const SolverChoice& linear_solver) {
  CostEstimate cost;
  const double span = task.end - task.initial.t, omega = frequency_of_motion(scales);
  cost.phase = span * omega;
  cost.known_phase = span * scales.omega;
  cost.smooth = model.traits().smooth;
  cost.driven = model.traits().time_dependent;
  Statistics unused;
  cost.explicit_steps = std::numeric_limits<double>::infinity();
  try {
    CriticalStep critical(model, unused);
    cost.explicit_steps = span / critical.at(task.initial);
    if (model.traits().damped) cost.damping_ratio = damping_ratio_of_motion(model, task, critical, scales);
  } catch (const RecoverableError&) {  // Integrator::start() reports the error
  }
  const NewtonMatrix matrix(model, linear_solver, TangentKind::exact, unused);
  // Totals over all ranks, so that the choice does not depend on the number of ranks.
  const double n = static_cast<double>(model.num_dofs_of_all());
  const double non_zeros = model.space().sum(model.pattern().non_zeros()), force = kForce * non_zeros;
  namespace each = solver_cost;
  cost.has_factor = !matrix.is_iterative();
  if (!cost.has_factor) {
    const double all = 2 * non_zeros;
    cost.solve_cost = each::kIterations * each::kIteration * all / force;
    cost.factor_cost = each::kSetUp * all / force;
    return cost;
  }
  const double entries = static_cast<double>(matrix.factor_bytes()) / each::kBytesPerEntry;
  cost.solve_cost = each::kSolve * entries / force;
  cost.factor_cost = each::kFactor * entries * entries / n / force;
  return cost;
}

}  // namespace

CostEstimate estimate_cost(const Model& model, const Task& task, const Scales& scales,
                           const SolverChoice& linear_solver) {
  CostEstimate cost = estimate_here(model, task, scales, linear_solver);
  if (model.ranks())
    for (double* value : {&cost.damping_ratio, &cost.explicit_steps, &cost.phase, &cost.known_phase, &cost.solve_cost,
                          &cost.factor_cost})
      model.ranks()->broadcast({value, 1});
  return cost;
}

double safety_of_central_differences(const CostEstimate& cost, double rtol) {
  constexpr double kErrorPerTolerance = 10, kEnergyPerTolerance = 100, kMost = 0.9;
  const double phase = std::max(cost.phase, cost.known_phase);
  const double at_limit = phase * std::pow(phase / cost.explicit_steps, 2) / 24;
  return std::min({kMost, std::sqrt(kErrorPerTolerance * rtol / at_limit), std::sqrt(kEnergyPerTolerance * rtol)});
}

MethodChoice choose_method(const CostEstimate& cost, double rtol, double most_explicit_steps) {
  const double implicit_steps = steps_for(cost.phase, rtol), step_cost = cost_of_implicit_step(cost);
  const double implicit_cost = implicit_steps * step_cost;
  const double safety = safety_of_central_differences(cost, rtol);
  const double explicit_cost = cost.explicit_steps / safety;  // one force per step
  if (explicit_cost < std::min(implicit_cost, most_explicit_steps))
    return {
        "central_differences",
        fmt::format("{:.2g} explicit steps cost less than about {:.2g} implicit ones", explicit_cost, implicit_steps),
        safety, std::nullopt, explicit_cost};
  const auto implicit = [&](const char* method, std::string why, double order = 2) {
    const double steps = steps_for(moving_phase(cost), rtol, order);
    return MethodChoice{method, std::move(why), std::nullopt, std::nullopt, steps * step_cost};
  };
  if (suits_high_orders(cost.damping_ratio, rtol))
    return implicit("cvode_bdf", "well damped, so multistep methods of high order take long steps", 4);
  if (rtol <= 1e-4)
    return implicit("arkode_dirk", "hardly damped, where Runge-Kutta methods of high order keep fast oscillations");
  if (const double error = phase_error_of_order_two(cost, rtol); error > kMostPhaseError * rtol)
    return implicit("arkode_dirk", fmt::format("hardly damped and {:.2g} periods long, over which a method of order 2 "
                                               "would have an error of {:.1g} of the motion",
                                               cost.known_phase / (2 * std::numbers::pi), error));
  return implicit("tr_bdf2", "hardly damped; for moderate accuracy an L-stable method of order 2 is cheapest");
}

}  // namespace orthodyn
