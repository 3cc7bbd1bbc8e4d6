#include "integrators/damping_ratio.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "integrators/newton_matrix.h"
#include "integrators/random_vector.h"

namespace orthodyn {

namespace {

// A position scale is about a tenth of the motion.
constexpr double kScaleOfMotion = 0.1;

// Measured numbers of steps with order 2 and with order 5, for a cantilever at rtol 1e-4: 1216 and 10150 at damping
// ratio 2.5e-4, 1186 and 3417 at 7.5e-4, 1062 and 1129 at 2.5e-3, 982 and 705 at 7.5e-3. At a loose tolerance and a
// damping ratio of 0.003, order 5 becomes inaccurate for a beam with a stiff part.
constexpr double kWellDamped = 1e-3, kWellDampedIfLoose = 5e-3, kLoose = 5e-3;

// x^T D x/x^T K x (s) of vibrations up to about the frequency omega (rad/s): x has two factors (omega^2 M + K)^-1 M.
// Infinite if K is indefinite or x has no stiffness.
double damping_time_below(const Model& model, const State& start, double omega) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  Statistics unused;
  NewtonMatrix matrix(model, "auto", TangentKind::exact, unused);
  matrix.linearize(start.t, start.q, start.v);
  if (!matrix.factor({omega * omega, 0, 1})) return kUnknown;
  Vector x = random_vector(model), y(x.size());
  for (int k = 0; k < 2; ++k) {
    model.multiply_mass(x, y);
    matrix.solve(y, x);
  }
  Linearization at;
  model.linearize(start.t, start.q, start.v, TangentKind::exact, at);
  std::vector<double> D(model.pattern().row.size());
  model.combine({0, 1, 0}, at, D.data());
  const VectorSpace space = model.space();
  matrix.multiply_stiffness(x, y);
  const double stiffness = space.dot(x, y);
  model.multiply_matrix(D.data(), x, y);
  return stiffness > 0 ? std::max(space.dot(x, y), 0.0) / stiffness : kUnknown;
}

}  // namespace

double frequency_of_motion(const Scales& scales) { return kScaleOfMotion * scales.velocity / scales.position; }

double damping_ratio_of_motion(const Model& model, const Task& task, const CriticalStep& critical,
                               const Scales& scales) {
  const double omega = frequency_of_motion(scales);
  double time = critical.damping_time();
  if (!model.traits().linear && !model.space().is_zero(task.initial.q)) {
    const double of_run = 2 * std::numbers::pi / (task.end - task.initial.t);
    time = std::min(time, damping_time_below(model, task.initial, std::max(omega, of_run)));
  }
  return time * omega / 2;
}

bool suits_high_orders(double damping_ratio, double rtol) {
  return damping_ratio > (rtol < kLoose ? kWellDamped : kWellDampedIfLoose);
}

}  // namespace orthodyn
