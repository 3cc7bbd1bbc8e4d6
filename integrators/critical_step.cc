#include "integrators/critical_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

double contact_stiffness_bound(const Model& model) {
  if (model.traits().linear) return 0;
  double sum = 0;
  for (const auto& part : model.force_parts()) {
    const double omega = model.only({part})->frequency_bound();
    sum += omega * omega;
  }
  return sum;
}

}  // namespace

CriticalStep::CriticalStep(const Model& model, Statistics& statistics)
    : model_(model),
      statistics_(statistics),
      contact_bound_(contact_stiffness_bound(model)),
      stiffness_(model),
      damping_(model) {}

double CriticalStep::limit(const State& state, double reserve) {
  const Measure measure(statistics_.tangent);
  Linearization at;
  model_.linearize(state.t, state.q, state.v, TangentKind::exact, at);
  const double present = largest(at, {0, 0, 1}, stiffness_), delta = largest(at, {0, 1, 0}, damping_);
  const double kappa = reserve + present;
  damping_time_ = present > 0 ? delta / present : 0;
  if (!std::isfinite(kappa + delta)) throw RecoverableError("the stiffness is not finite");
  return 2 / (delta + std::sqrt(delta * delta + kappa));
}

double CriticalStep::largest(const Linearization& at, const Weights& weights, SpectralBound& bound) {
  std::vector<double> values(model_.pattern().row.size());
  model_.combine(weights, at, values.data());
  const bool absent = model_.space().all(std::all_of(values.begin(), values.end(), [](double x) { return x == 0; }));
  return absent ? 0 : bound.largest(values.data());
}

void refuse_too_many_steps(const std::string& name, const Model& model, const Task& task, double reach,
                           long max_steps) {
  Statistics unused;
  double longest = 0;
  try {
    longest = reach * CriticalStep(model, unused).at_present(task.initial);
  } catch (const RecoverableError&) {
    return;  // Integrator::start() reports the error
  }
  const double steps = (task.end - task.initial.t) / longest;
  if (steps > static_cast<double>(max_steps))
    throw ConfigError(
        fmt::format("{} would take at least {:.2g} steps, of {:.3g} s at most for the stiffness at the start, more "
                    "than max_steps, {}; use an implicit integrator, or raise max_steps",
                    name, steps, longest, max_steps));
}

}  // namespace orthodyn
