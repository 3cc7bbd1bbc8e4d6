#include "integrators/automatic/outlook.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "integrators/critical_step.h"
#include "integrators/newton_matrix.h"
#include "lib/core/errors.h"

namespace orthodyn {

namespace {

// Measured: a force takes about 2.2 ns per entry of the tangent's lower triangle, a solve 1 ns per entry of the
// factor, a factorisation 0.15 ns per multiplication.
constexpr double kForce = 2.2, kSolve = 1, kFactor = 0.15;
constexpr double kBytesPerEntry = 10;  // of the factor, workspace included

double explicit_steps(const Model& model, const Task& task) {
  Statistics unused;
  try {
    const double step = 0.9 * CriticalStep(model, unused).at(task.initial);
    return (task.end - task.initial.t) / step;
  } catch (const RecoverableError&) {
    return std::numeric_limits<double>::infinity();
  }
}

}  // namespace

Outlook look_at(const Model& model, const Task& task, const Scales& scales, const std::string& linear_solver) {
  Outlook look;
  look.damped = model.traits().damped;
  look.explicit_steps = explicit_steps(model, task);
  look.swings = (task.end - task.initial.t) * scales.velocity / scales.position;
  Statistics unused;
  const NewtonMatrix matrix(model, linear_solver, TangentKind::exact, unused);
  const double n = model.num_dofs(), force = kForce * model.pattern().non_zeros();
  const double entries = static_cast<double>(matrix.factor_bytes()) / kBytesPerEntry;
  look.solve_cost = kSolve * entries / force;
  look.factor_cost = kFactor * entries * entries / n / force;
  return look;
}

Advice advise(const Outlook& look, double rtol) {
  // Steps of an implicit method of order two; each takes two to three iterations, and one in five a new factor.
  const double implicit_steps = 3 * look.swings * std::pow(1e-3 / rtol, 1.0 / 3) + 20;
  const double implicit_cost = implicit_steps * (2.5 * (1 + look.solve_cost) + 0.2 * look.factor_cost);
  if (look.explicit_steps < implicit_cost)
    return {"central_differences", fmt::format("{:.2g} explicit steps cost less than {:.2g} implicit ones",
                                               look.explicit_steps, implicit_steps)};
  if (look.damped) return {"cvode_bdf", "damped everywhere: multistep methods of high order take long steps"};
  if (rtol < 1e-3) return {"arkode_dirk", "undamped: Runge-Kutta methods of high order keep fast oscillations"};
  return {"tr_bdf2", "undamped, and a moderate accuracy: an L-stable method of order 2"};
}

}  // namespace orthodyn
