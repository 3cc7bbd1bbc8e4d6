#include "tools/python/binding/scene_model.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "lib/simulation/modes/modal_analysis.h"
#include "lib/simulation/sensitivity/frequency_sensitivity.h"
#include "lib/simulation/sensitivity/shape_sensitivity.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn::python {

void SceneModel::require_size(const ConstVectorRef& x, const char* name) const {
  if (x.size() != model().num_dofs())
    throw pybind11::value_error(
        fmt::format("{} has {} numbers; the model has {} free coordinates", name, x.size(), model().num_dofs()));
}

Vector SceneModel::force(double t, const ConstVectorRef& q, const ConstVectorRef& v) const {
  require_size(q, "q"), require_size(v, "v");
  Vector f(model().num_dofs());
  model().force(t, q, v, f);
  return f;
}

std::pair<std::vector<double>, std::vector<double>> SceneModel::tangent(double t, const ConstVectorRef& q,
                                                                        const ConstVectorRef& v,
                                                                        bool gauss_newton) const {
  require_size(q, "q"), require_size(v, "v");
  Linearization at;
  model().linearize(t, q, v, gauss_newton ? TangentKind::gauss_newton : TangentKind::exact, at);
  std::vector<double> stiffness(at.stiffness.size()), damping;
  model().combine({0, 0, 1}, at, stiffness.data());
  if (model().traits().damping_matrix || model().parts().mass_damping > 0) {
    damping.resize(at.stiffness.size());
    model().combine({0, 1, 0}, at, damping.data());
  }
  return {std::move(stiffness), std::move(damping)};
}

std::vector<double> SceneModel::mass() const {
  const Vector zero = Vector::Zero(model().num_dofs());
  Linearization at;
  at.stiffness.assign(static_cast<std::size_t>(model().pattern().non_zeros()), 0);
  if (model().traits().damping_matrix) at.damping = at.stiffness;
  std::vector<double> values(at.stiffness.size());
  model().combine({1, 0, 0}, at, values.data());
  return values;
}

Vector SceneModel::solve_mass(const ConstVectorRef& x) const {
  require_size(x, "x");
  Vector out = x;
  model().solve_mass(out);
  return out;
}

std::vector<int> SceneModel::unknowns() const {
  std::vector<int> out;
  const DofMap& dofs = *model().parts().dofs;
  for (int i = 0; i < dofs.num_nodes(); ++i)
    for (const int dof : dofs.node(i)) out.push_back(dof < 0 ? -1 : dof);
  return out;
}

std::vector<double> SceneModel::points() const {
  const NodalVector& rest = *model().parts().rest;
  return {rest.data(), rest.data() + rest.size()};
}

std::vector<double> SceneModel::evaluate(const std::string& name, double t, const ConstVectorRef& q,
                                         const ConstVectorRef& v) const {
  require_size(q, "q"), require_size(v, "v");
  return model().evaluate(name, {t, q, v});
}

SceneModel::FoundModes SceneModel::modes(int count, bool about_equilibrium, const std::vector<std::string>& paths,
                                         bool of_shapes) const {
  const auto parameters = scene_parameters(setup_.config, paths);
  const ModalAnalysis analysis(setup_, count, about_equilibrium);
  FoundModes found{{}, {}, analysis.mesh_errors(), {}, {}};
  for (const Mode& mode : analysis.modes().modes) {
    found.frequencies.push_back(mode.frequency());
    found.shapes.insert(found.shapes.end(), mode.shape.data(), mode.shape.data() + mode.shape.size());
  }
  for (FrequencySensitivity& one : frequency_sensitivities(setup_.config, analysis, parameters))
    found.frequency_slopes.push_back(std::move(one.derivatives));
  if (!of_shapes) return found;
  const auto shapes =
      shape_sensitivities(setup_.config, analysis.model(), analysis.about(), analysis.modes(), parameters);
  for (const ShapeSensitivity& one : shapes.by_parameter) {
    auto& rows = found.shape_slopes.emplace_back();
    for (const Vector& row : one.derivatives) {
      rows.insert(rows.end(), row.data(), row.data() + row.size());
      rows.resize(rows.size() + static_cast<std::size_t>(model().num_dofs() - row.size()),
                  std::numeric_limits<double>::quiet_NaN());
    }
  }
  return found;
}

Vector SceneModel::equilibrium() const {
  if (setup_.scene.is_static()) return orthodyn::equilibrium(setup_.scene, setup_.built);
  Scene still = at_rest(setup_.scene);
  still.time.end = setup_.scene.time.end;
  return orthodyn::equilibrium(still, build(still));
}

}  // namespace orthodyn::python
