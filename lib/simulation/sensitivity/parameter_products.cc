#include "lib/simulation/sensitivity/parameter_products.h"

#include <fmt/format.h>

namespace orthodyn {

ParameterProducts::ParameterProducts(const Config& config, const Scene& scene, const BuiltScene& built,
                                     const std::vector<SceneParameter>& parameters)
    : model_(*built.model), is_static_(scene.is_static()) {
  const auto& [start, end] = scene.time;
  for (const SceneParameter& parameter : parameters) {
    Parameter& one = parameters_.emplace_back();
    one.cell = StiffnessCell::find(parameter.path(), scene, model_);
    if (one.cell) continue;
    one.changed.emplace(config, model_, parameter, ChangeCount::two, ChangedMotion::as_given);
    if (is_static_) continue;
    needs_acceleration_ = true;
    for (const auto& changed : one.changed->models())
      if (changed.model().breakpoints(start, end) != model_.breakpoints(start, end))
        throw ConfigError(parameter.path(),
                          "changes a time at which a load has a kink or jumps; derivatives with "
                          "respect to such times are not computed");
  }
}

void ParameterProducts::compute(const State& state, const ConstVectorRef& b, VectorRef out) const {
  const auto& parts = model_.parts();
  const NodalExpansion nodal(parts, state.t, state.q, state.v, state.load_factor);
  NodalVector weights = NodalVector::Zero(3, nodal.x.cols()), work = weights;
  parts.dofs->add_to(b, weights);
  Vector acceleration, force(b.size()), inertia(b.size());
  if (needs_acceleration_) {
    acceleration.resize(b.size());
    model_.force(state.t, state.q, state.v, acceleration);
    model_.solve_mass(acceleration);
  }
  for (int i = 0; i < count(); ++i) {
    const Parameter& one = parameters_[static_cast<std::size_t>(i)];
    out[i] = one.cell ? one.cell->product(nodal, weights, work)
                      : one.changed->derivative([&](const ChangedModels::Changed& changed) {
                          changed.model().force(state.t, state.q, state.v, force);
                          double product = b.dot(force);
                          if (needs_acceleration_) {
                            changed.model().multiply_mass(acceleration, inertia);
                            product -= b.dot(inertia);
                          }
                          return product;
                        });
  }
}

State ParameterProducts::initial_derivative(int i) const {
  const Parameter& one = parameters_[static_cast<std::size_t>(i)];
  const Vector zero = Vector::Zero(model_.num_dofs());
  if (one.cell) return {0, zero, zero};
  return {0, one.changed->derivative([](const ChangedModels::Changed& changed) { return changed.built.initial.q; }),
          one.changed->derivative([](const ChangedModels::Changed& changed) { return changed.built.initial.v; })};
}

}  // namespace orthodyn
