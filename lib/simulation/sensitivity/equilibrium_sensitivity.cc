#include "lib/simulation/sensitivity/equilibrium_sensitivity.h"

#include <optional>
#include <utility>

#include "lib/core/errors.h"
#include "lib/simulation/sensitivity/stiffness_cell.h"

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

Eigen::VectorXd EquilibriumSensitivity::derivatives(const SceneParameter& parameter, const SceneOutputs& outputs,
                                                    bool kinematic) const {
  const Vector zero = Vector::Zero(equilibrium_.q.size());
  const auto cell = StiffnessCell::find(parameter.path(), scene_, model_);
  std::optional<ChangedModels> changed_models;
  if (!cell || !kinematic) changed_models.emplace(config_, model_, parameter);
  const Vector load =
      cell ? cell->force(equilibrium_) : changed_models->derivative([&](const ChangedModels::Changed& changed) {
        Vector force(zero.size());
        changed.model().force(equilibrium_.t, equilibrium_.q, zero, force);
        return force;
      });
  State slope{equilibrium_.t, Vector(load.size()), zero};
  factor_->solve(load, slope.q);
  const Eigen::VectorXd along =
      derivative_along(slope, parameter.usual_change(), scene_, model_, equilibrium_, outputs);
  if (!changed_models) return along;
  return along + changed_models->derivative([&](const ChangedModels::Changed& changed) {
    return outputs(changed.scene, changed.model(), equilibrium_);
  });
}

}  // namespace orthodyn
