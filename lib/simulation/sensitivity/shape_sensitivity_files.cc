#include "lib/simulation/sensitivity/shape_sensitivity_files.h"

#include <fmt/format.h>

#include <limits>
#include <string>

#include "lib/scene/quantity.h"
#include "lib/simulation/modes/mode_files.h"
#include "lib/simulation/output/files.h"

namespace orthodyn {

namespace {

// The displacements at a probe for a small vector of unknowns; NaN for an empty vector.
std::vector<double> displacements_at(const Quantity& probe, const FemModel& model, const State& about,
                                     const Vector& x) {
  constexpr std::size_t kComponents = 3;
  if (x.size() == 0) return std::vector<double>(kComponents, std::numeric_limits<double>::quiet_NaN());
  const State moved{about.t, about.q + x, about.v, about.load_factor};
  std::vector<double> values = probe.values(ObservedState(model, moved));
  const std::vector<double> before = probe.values(ObservedState(model, about));
  for (std::size_t i = 0; i < kComponents; ++i) values[i] -= before[i];
  values.resize(kComponents);
  return values;
}

void write_probes(const std::filesystem::path& path, const Scene& scene, const ModalAnalysis& analysis,
                  const ShapeSensitivities& sensitivities) {
  std::vector<std::string> header{"mode", "frequency [Hz]"};
  std::vector<Quantity> probes;
  for (const auto& [name, probe] : scene.output.probes) {
    probes.push_back(find_quantity(name + ".displacement", scene, analysis.model(), {}));
    for (const char* axis : {"x", "y", "z"}) {
      const std::string value = fmt::format("{}.shape.{}", name, axis);
      header.push_back(value + " [1/sqrt(kg)]");
      for (const ShapeSensitivity& one : sensitivities.by_parameter)
        header.push_back(fmt::format("d {} / d {} [1/sqrt(kg) / SI unit]", value, one.parameter.path()));
    }
  }
  CsvFile file(path, header);
  file.begin();
  for (std::size_t k = 0; k < analysis.modes().modes.size(); ++k) {
    const Mode& mode = analysis.modes().modes[k];
    std::vector<double> row{static_cast<double>(k + 1), mode.frequency()};
    for (const Quantity& probe : probes) {
      const auto at = [&](const Vector& x) { return displacements_at(probe, analysis.model(), analysis.about(), x); };
      const std::vector<double> shape = at(mode.shape);
      std::vector<std::vector<double>> slopes;
      for (const ShapeSensitivity& one : sensitivities.by_parameter) slopes.push_back(at(one.derivatives[k]));
      for (std::size_t i = 0; i < shape.size(); ++i) {
        row.push_back(shape[i]);
        for (const std::vector<double>& slope : slopes) row.push_back(slope[i]);
      }
    }
    file.row(row);
  }
}

}  // namespace

void write_shape_sensitivities(const std::filesystem::path& folder, const Scene& scene, const ModalAnalysis& analysis,
                               const ShapeSensitivities& sensitivities) {
  std::vector<Vector> shapes;
  std::vector<std::vector<ShapeField>> fields;
  for (std::size_t k = 0; k < analysis.modes().modes.size(); ++k) {
    shapes.push_back(analysis.modes().modes[k].shape);
    fields.emplace_back();
    if (!sensitivities.missing[k].empty()) continue;
    for (const ShapeSensitivity& one : sensitivities.by_parameter)
      fields.back().push_back({fmt::format("d shape / d {}", one.parameter.path()), one.derivatives[k]});
  }
  write_shapes(folder, analysis.model(), analysis.about(), shapes, fields);
  if (!scene.output.probes.empty()) write_probes(folder / "shape_sensitivities.csv", scene, analysis, sensitivities);
}

}  // namespace orthodyn
