#include "lib/simulation/sensitivity/equilibrium_sensitivity.h"

#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr double kFullLoad = 1;  // the time of a LoadPath at its end

}  // namespace

EquilibriumSensitivity::EquilibriumSensitivity(const Config& config, const Scene& scene, const FemModel& model,
                                               const LoadPath& path, State equilibrium)
    : config_(config), scene_(scene), model_(model), equilibrium_(std::move(equilibrium)) {
  path.linearize(kFullLoad, equilibrium_.q, Vector::Zero(equilibrium_.q.size()), TangentKind::exact, tangent_);
  values_.resize(path.pattern().row.size());
  path.combine({0, 0, 1}, tangent_, values_.data());
  factor_ = path.pattern().symmetric ? make_indefinite_solver(path.pattern()) : make_solver_for(path.pattern());
  if (factor_->factor(values_.data()) != FactorStatus::ok)
    throw RunError("the stiffness at the equilibrium is singular, so the derivatives do not exist");
}

Eigen::VectorXd EquilibriumSensitivity::derivatives(const SceneParameter& parameter,
                                                    const SceneOutputs& outputs) const {
  const ChangedModels changed_models(config_, model_, parameter);
  const Vector zero = Vector::Zero(equilibrium_.q.size());
  const Vector load = changed_models.derivative([&](const ChangedModels::Changed& changed) {
    Vector force(zero.size());
    changed.model().force(equilibrium_.t, equilibrium_.q, zero, force);
    return force;
  });
  State slope{equilibrium_.t, Vector(load.size()), zero};
  factor_->solve(load, slope.q);
  const Eigen::VectorXd at_fixed_q = changed_models.derivative(
      [&](const ChangedModels::Changed& changed) { return outputs(changed.scene, changed.model(), equilibrium_); });
  return at_fixed_q + derivative_along(slope, parameter.usual_change(), scene_, model_, equilibrium_, outputs);
}

}  // namespace orthodyn
