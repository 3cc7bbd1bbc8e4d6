#include "lib/simulation/sensitivity/changed_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/spelling.h"
#include "lib/mesh/selection.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/sensitivity/stiffness_cell.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn {

namespace {

// Shares of SceneParameter::usual_change().
constexpr double kStepOfFour = 0.3, kStepOfTwo = 0.01, kLastStep = 1e-4;

// Constants of a material that is repaired do not act as they are given.
void require_unrepaired(const Config& scene, const std::string& path) {
  if (!path.starts_with("materials.")) return;
  const std::string material = path.substr(0, path.find('.', std::string("materials.").size()));
  for (const char* key : {"repair", "symmetrise"}) {
    const std::string at = material + "." + key;
    if (!has_value_at(scene, at)) continue;
    const std::string value = value_at(scene, at).text();
    if (value != "none" && value != "false")
      throw ConfigError(path,
                        fmt::format("the material has {}: {}, so that its constants do not act as they are given; "
                                    "give those of a stable material, and remove the key",
                                    key, value));
  }
}

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
double step_of(const Config& scene, const SceneParameter& parameter, ChangeCount count) {
  double h = (count == ChangeCount::four ? kStepOfFour : kStepOfTwo) * parameter.usual_change();
  while (!allows(scene, parameter, h)) {
    h /= 2;
    if (h < kLastStep * parameter.usual_change()) read_scene(parameter.changed(scene, 2 * h));  // throws
    if (h < kLastStep * parameter.usual_change() / 2) read_scene(parameter.changed(scene, -2 * h));
  }
  return h;
}

// Sections of a scene whose numbers are part of the model or of the initial state.
constexpr std::array kModelSections{"activation", "damping",  "gravity", "initial", "loads",       "materials",
                                    "mesh",       "moisture", "motions", "regions", "temperature", "terms"};
// The same of a harmonic analysis.
constexpr std::array kHarmonicSections{"harmonic.losses.", "harmonic.damping_ratio", "harmonic.base_acceleration."};

void require_part_of_model(const std::string& path, const SourceLocation& origin) {
  const std::string section = path.substr(0, path.find('.'));
  if (std::find(kModelSections.begin(), kModelSections.end(), section) != kModelSections.end()) return;
  if (std::ranges::any_of(kHarmonicSections, [&](const char* begin) { return path.starts_with(begin); })) return;
  origin.fail(fmt::format("'{}' is no number of the model: sensitivities are with respect to numbers of {}", path,
                          join(std::vector<std::string>(kModelSections.begin(), kModelSections.end()))));
}

}  // namespace

ChangedModels::ChangedModels(const Config& scene, const FemModel& original, const SceneParameter& parameter,
                             ChangeCount count, ChangedMotion motion)
    : step_(step_of(scene, parameter, count)) {
  const bool stays = motion == ChangedMotion::as_given;
  for (const int steps : count == ChangeCount::four ? std::vector{-2, -1, 1, 2} : std::vector{-1, 1}) {
    const Scene read = read_scene(parameter.changed(scene, steps * step_));
    Changed changed{steps * step_, stays || read.is_static() ? read : at_rest(read), {}};
    changed.built = build(changed.scene);
    if (changed.model().num_dofs() != original.num_dofs() || changed.model().pattern().row != original.pattern().row)
      throw ConfigError(parameter.path(), "changes the connections of the mesh; choose another parameter");
    models_.push_back(std::move(changed));
  }
}

double small_displacement(const FemModel& model) {
  constexpr double kShare = 1e-4;
  return kShare * bounding_box(model.parts().mesh).size().minCoeff();
}

SceneOutputs named_quantities(const std::vector<std::string>& names, const Scene& scene, const FemModel& model) {
  std::vector<Quantity> quantities;
  for (const std::string& name : names) quantities.push_back(find_quantity(name, scene, model, {}));
  return [quantities](const Scene&, const FemModel& of, const State& state) {
    const ObservedState observed(of, state);
    Eigen::VectorXd all(static_cast<Eigen::Index>(quantities.size()));
    for (Eigen::Index i = 0; i < all.size(); ++i) {
      const Quantity& quantity = quantities[static_cast<std::size_t>(i)];
      if (quantity.values_on) all[i] = quantity.values_on(observed, of.parts().mesh).at(0);
      else all[i] = quantity.values ? quantity.values(observed).at(0) : std::numeric_limits<double>::quiet_NaN();
    }
    return all;
  };
}

bool is_kinematic(const std::string& quantity, const Scene& scene) {
  const auto is_of = [&](const auto& gauge) { return quantity.starts_with(gauge.first + "."); };
  if (std::ranges::any_of(scene.output.gauges, is_of)) return true;
  constexpr std::array kFields{"displacement", "velocity", "nodal_strain", "nodal_strain_space"};
  if (quantity.find("stress") != std::string::npos) return false;  // a probe may have the name of a field
  for (std::size_t begin = 0; begin <= quantity.size();) {
    const std::size_t end = std::min(quantity.find('.', begin), quantity.size());
    if (std::ranges::find(kFields, quantity.substr(begin, end - begin)) != kFields.end()) return true;
    begin = end + 1;
  }
  return false;
}

Eigen::VectorXd derivative_along(const State& direction, double longest, const Scene& scene, const FemModel& model,
                                 const State& state, const SceneOutputs& outputs) {
  const double small = small_displacement(model);
  const double largest = direction.q.lpNorm<Eigen::Infinity>();
  const double h = largest * longest > small ? small / largest : longest;
  const auto at = [&](double steps) {
    return outputs(
        scene, model,
        State{state.t, state.q + steps * h * direction.q, state.v + steps * h * direction.v, state.load_factor});
  };
  return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
}

std::vector<SceneParameter> model_parameters(const Config& scene, const std::vector<std::string>& paths,
                                             const SourceLocation& origin) {
  std::vector<SceneParameter> parameters;
  for (const std::string& path : paths) {
    require_part_of_model(path, origin);
    parameters.emplace_back(scene, path);
    try {
      require_changeable(scene, parameters.back());
    } catch (const ConfigError& e) {
      origin.fail(fmt::format("'{}' cannot be a parameter: {}", path, e.message()));
    }
  }
  return parameters;
}

void require_changeable(const Config& scene, const SceneParameter& parameter) {
  if (StiffnessCell::is_path(parameter.path())) return;  // any positive value is allowed
  require_unrepaired(scene, parameter.path());
  step_of(scene, parameter, ChangeCount::four);
}

}  // namespace orthodyn
