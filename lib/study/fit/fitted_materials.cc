// The fitted constants as materials to use in scenes.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "lib/analysis/strain_limits.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/material/material.h"
#include "lib/simulation/sensitivity/scene_parameter.h"
#include "lib/study/fit/result.h"

namespace orthodyn::study::fit {

namespace {

// "spruce" of "materials.spruce.young.0"; "" for another path.
std::string material_of(const std::string& path) {
  const std::string first = "materials.";
  if (!path.starts_with(first)) return "";
  return path.substr(first.size(), path.find('.', first.size()) - first.size());
}

std::string interval_line(const FittedParameter& parameter, const Estimate& estimate) {
  const auto shown = [&](double si) { return fmt::format("{:.5g}", si / parameter.factor); };
  const std::string interval = std::isfinite(estimate.deviation)
                                   ? fmt::format("95 % interval {} to {}", shown(estimate.low), shown(estimate.high))
                                   : "the data do not determine it";
  return fmt::format("# {} = {}{}{}: {}\n", parameter.name, shown(estimate.value), parameter.unit.empty() ? "" : " ",
                     parameter.unit, interval);
}

// That the material is stable, and up to which compression its law is.
std::string verdict(const Material& material) {
  const Vec6 eigenvalues = symmetric_eigenvalues(voigt(material.stiffness()));
  std::string text = fmt::format("# Stable: the eigenvalues of the stiffness are {:.3g} to {:.3g} Pa.\n",
                                 eigenvalues.minCoeff(), eigenvalues.maxCoeff());
  const auto limits = strain_limits(material.stiffness());
  for (int axis = 0; axis < 3; ++axis)
    if (const auto& limit = limits[static_cast<std::size_t>(axis)].compression)
      text += fmt::format("# Compression along axis {} by more than {:.3g} %: {}.\n", axis + 1, -100 * limit->strain,
                          describe(*limit, axis));
  return text;
}

// The scene with the fitted values, to eight digits.
Config rounded_scene(const Problem& problem, const Result& result, const PreparedExperiment& experiment) {
  Config scene = experiment.scene.copy();
  for (std::size_t p = 0; p < problem.parameters().size(); ++p) {
    const FittedParameter& parameter = problem.parameters()[p];
    const double value = result.statistics.estimates[p].value / parameter.factor;
    for (const std::string& path : experiment.paths[p])
      scene.set_yaml(path, fmt::format("{:.8g}{}{}", value, parameter.unit.empty() ? "" : " ", parameter.unit));
  }
  return scene;
}

}  // namespace

std::vector<FittedMaterial> fitted_materials(const Fit& fit, const Problem& problem, const Result& result) {
  std::map<std::string, std::string> comments;  // by material
  for (const std::size_t p : problem.single_parameters())
    for (const std::string& path : problem.parameters()[p].paths)
      if (const std::string material = material_of(path); !material.empty())
        comments[material] += interval_line(problem.parameters()[p], result.statistics.estimates[p]);
  std::vector<FittedMaterial> out;
  for (const auto& [material, comment] : comments)
    for (const PreparedExperiment& experiment : problem.experiments()) {
      if (experiment.is_candidate || !has_value_at(experiment.scene, "materials." + material)) continue;
      const Config scene = rounded_scene(problem, result, experiment);
      const Config section = scene.at("materials").at(material);
      std::string yaml =
          fmt::format("# {} from the fit {}. Use it in a scene by\n#   materials: {{{}: {{include: {}.yaml}}}}\n",
                      material, fit.name, material, material);
      yaml += comment;
      yaml += verdict(*Registry<Material>::read(section.copy()));
      for (const std::string& key : section.keys()) yaml += fmt::format("{}: {}\n", key, section.at(key).yaml());
      out.push_back({material, yaml});
      break;
    }
  return out;
}

}  // namespace orthodyn::study::fit
