#include "integrators/damping_ratio.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "integrators/random_vector.h"
#include "lib/core/errors.h"
#include "lib/linear/solver.h"

namespace orthodyn {

namespace {

// A position scale is about a tenth of the motion.
constexpr double kScaleOfMotion = 0.1;

// Measured numbers of steps with order 2 and with order 5, for a cantilever at rtol 1e-4: 1216 and 10150 at damping
// ratio 2.5e-4, 1186 and 3417 at 7.5e-4, 1062 and 1129 at 2.5e-3, 982 and 705 at 7.5e-3. At a loose tolerance and a
// damping ratio of 0.003, order 5 becomes inaccurate for a beam with a stiff part.
constexpr double kWellDamped = 1e-3, kWellDampedIfLoose = 5e-3, kLoose = 5e-3;

// x^T D x/x^T K x (s) of vibrations up to about the frequency omega (rad/s): x has two factors (omega^2 M + K)^-1 M.
// Infinite if this matrix is not definite, if an iterative solver does not converge, or if x has no stiffness.
double damping_time_below(const Model& model, const State& start, double omega) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  Linearization at;
  model.linearize(start.t, start.q, start.v, TangentKind::exact, at);
  std::vector<double> values(model.pattern().row.size());
  const auto combine = [&](const Weights& weights) { model.combine(weights, at, values.data()); };
  const auto solver = make_linear_solver({model.pattern().symmetric ? "auto" : "klu"}, model.pattern());
  combine({omega * omega, 0, 1});
  if (solver->factor(values.data()) != FactorStatus::ok) return kUnknown;
  Vector x = random_vector(model), y(x.size());
  try {
    for (int k = 0; k < 2; ++k) {
      model.multiply_mass(x, y);
      solver->solve(y, x);
    }
  } catch (const RecoverableError&) {
    return kUnknown;
  }
  const auto form = [&](const Weights& weights) {
    combine(weights);
    model.multiply_matrix(values.data(), x, y);
    return std::max(model.space().dot(x, y), 0.0);
  };
  const double damping = form({0, 1, 0}), stiffness = form({0, 0, 1});
  return stiffness > 0 ? damping / stiffness : kUnknown;
}

}  // namespace

double frequency_of_motion(const Scales& scales) { return kScaleOfMotion * scales.velocity / scales.position; }

double damping_ratio_of_motion(const Model& model, const Task& task, const CriticalStep& critical,
                               const Scales& scales) {
  const double omega = frequency_of_motion(scales);
  double time = critical.damping_time();
  const bool may_suffice = suits_high_orders(time * omega / 2, std::numeric_limits<double>::min());
  if (may_suffice && !model.traits().linear && !model.space().is_zero(task.initial.q)) {
    const double of_run = 2 * std::numbers::pi / (task.end - task.initial.t);
    time = std::min(time, damping_time_below(model, task.initial, std::max(omega, of_run)));
  }
  return time * omega / 2;
}

bool suits_high_orders(double damping_ratio, double rtol) {
  return damping_ratio > (rtol < kLoose ? kWellDamped : kWellDampedIfLoose);
}

}  // namespace orthodyn
