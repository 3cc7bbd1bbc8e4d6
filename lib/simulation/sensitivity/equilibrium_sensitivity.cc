#include "lib/simulation/sensitivity/equilibrium_sensitivity.h"

#include <utility>

#include "lib/core/errors.h"
#include "lib/mesh/selection.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/sensitivity/changed_models.h"

namespace orthodyn {

namespace {

constexpr double kFullLoad = 1;      // the time of a LoadPath at its end
constexpr double kSmallStep = 1e-4;  // displacements over the smallest side of the body

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

std::vector<double> EquilibriumSensitivity::derivatives(const SceneParameter& parameter,
                                                        const std::vector<std::string>& quantities) const {
  const ChangedModels changed_models(config_, model_, parameter);
  const Vector zero = Vector::Zero(equilibrium_.q.size());
  const Vector load = changed_models.derivative([&](const ChangedModels::Changed& changed) {
    Vector force(zero.size());
    changed.model().force(equilibrium_.t, equilibrium_.q, zero, force);
    return force;
  });
  Vector slope(load.size());
  factor_->solve(load, slope);
  const auto values = [&](const Scene& scene, const FemModel& model, const Vector& q) {
    const State state{equilibrium_.t, q, zero};
    const ObservedState observed(model, state);
    Eigen::VectorXd all(static_cast<Eigen::Index>(quantities.size()));
    for (Eigen::Index i = 0; i < all.size(); ++i)
      all[i] = find_quantity(quantities[static_cast<std::size_t>(i)], scene, model, {}).values(observed).at(0);
    return all;
  };
  const Eigen::VectorXd at_fixed_q = changed_models.derivative(
      [&](const ChangedModels::Changed& changed) { return values(changed.scene, changed.model(), equilibrium_.q); });
  const double largest = slope.lpNorm<Eigen::Infinity>();
  if (largest == 0) return {at_fixed_q.begin(), at_fixed_q.end()};
  // Along the slope by steps that are small beside the body: a slender body resists larger straight steps strongly.
  const double h = kSmallStep * bounding_box(model_.parts().mesh).size().minCoeff() / largest;
  const auto at = [&](double steps) { return values(scene_, model_, equilibrium_.q + steps * h * slope); };
  const Eigen::VectorXd along = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
  const Eigen::VectorXd out = at_fixed_q + along;
  return {out.begin(), out.end()};
}

}  // namespace orthodyn
