#include "lib/simulation/sensitivity/changed_models.h"

#include "lib/core/errors.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn {

namespace {

constexpr double kFirstStep = 0.3, kLastStep = 1e-4;  // shares of SceneParameter::usual_change()

// Whether the scene can be read with the parameter at two steps h to both sides.
bool allows(const Config& scene, const SceneParameter& parameter, double h) {
  try {
    for (const int steps : {-2, 2}) read_scene(parameter.changed(scene, steps * h));
    return true;
  } catch (const ConfigError&) {
    return false;
  }
}

// Step of the differences, in SI units of the parameter.
double step_of(const Config& scene, const SceneParameter& parameter) {
  double h = kFirstStep * parameter.usual_change();
  while (!allows(scene, parameter, h)) {
    h /= 2;
    if (h < kLastStep * parameter.usual_change()) read_scene(parameter.changed(scene, 2 * h));  // throws
    if (h < kLastStep * parameter.usual_change() / 2) read_scene(parameter.changed(scene, -2 * h));
  }
  return h;
}

}  // namespace

ChangedModels::ChangedModels(const Config& scene, const FemModel& original, const SceneParameter& parameter)
    : step_(step_of(scene, parameter)) {
  for (const int steps : {-2, -1, 1, 2}) {
    const Scene read = read_scene(parameter.changed(scene, steps * step_));
    Changed changed{steps * step_, read.is_static() ? read : at_rest(read), {}};
    changed.built = build(changed.scene);
    if (changed.model().num_dofs() != original.num_dofs() || changed.model().pattern().row != original.pattern().row)
      throw ConfigError(parameter.path(), "changes the connections of the mesh; choose another parameter");
    models_.push_back(std::move(changed));
  }
}

void require_changeable(const Config& scene, const SceneParameter& parameter) { step_of(scene, parameter); }

}  // namespace orthodyn
