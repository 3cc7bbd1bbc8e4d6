#include "integrators/critical_step.h"

#include <algorithm>
#include <cmath>

#include "lib/core/errors.h"

namespace orthodyn {

CriticalStep::CriticalStep(const Model& model, Statistics& statistics)
    : model_(model), statistics_(statistics), stiffness_(model), damping_(model),
      values_(model.pattern().row.size()) {}

double CriticalStep::at(const State& state) {
  const Measure measure(statistics_.tangent);
  model_.linearize(state.t, state.q, state.v, TangentKind::exact, linearization_);
  const double kappa = largest({0, 0, 1}, stiffness_), delta = largest({0, 1, 0}, damping_);
  if (!std::isfinite(kappa + delta)) throw RecoverableError("the stiffness is not finite");
  return 2 / (delta + std::sqrt(delta * delta + kappa));
}

double CriticalStep::largest(const Weights& weights, SpectralBound& bound) {
  model_.combine(weights, linearization_, values_.data());
  const bool absent = std::all_of(values_.begin(), values_.end(), [](double x) { return x == 0; });
  return absent ? 0 : bound.largest(values_.data());
}

}  // namespace orthodyn
