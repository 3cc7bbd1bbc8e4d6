#include "lib/simulation/sensitivity/sensitivity_table.h"

#include <fmt/format.h>

#include <string>

#include "lib/simulation/output/run_observers.h"

namespace orthodyn {

namespace {

// First `axis`, then for each quantity a column per parameter.
std::vector<std::string> header_of(const std::string& axis, const ProbeColumns& quantities,
                                   const std::vector<SceneParameter>& parameters) {
  std::vector<std::string> header{axis};
  for (const auto& [name, unit] : quantities.names_and_units())
    for (const SceneParameter& parameter : parameters)
      header.push_back(fmt::format("d {} / d {} [{} / SI unit]", name, parameter.path(), unit.empty() ? "1" : unit));
  return header;
}

SceneOutputs outputs_of(const ProbeColumns& quantities) {
  return [&quantities](const Scene&, const FemModel& model, const State& state) -> Eigen::VectorXd {
    const auto values = quantities.values_on(model.parts().mesh, {model, state});
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  };
}

// `slopes`: of all quantities, per parameter.
std::vector<double> row_of(double axis, const std::vector<Eigen::VectorXd>& slopes) {
  std::vector<double> row{axis};
  for (Eigen::Index k = 0; k < slopes.front().size(); ++k)
    for (const Eigen::VectorXd& slope : slopes) row.push_back(slope[k]);
  return row;
}

std::vector<double> entries_of(const Vector& v) { return {v.begin(), v.end()}; }

}  // namespace

ProbeColumns sensitivity_quantities(const Scene& scene, const FemModel& model) {
  std::vector<ProbeColumn> columns = probe_columns(scene, model);
  if (scene.output.energy)
    for (const char* energy : {"energy.elastic", "energy.kinetic"})
      if (!scene.is_static() || std::string_view(energy) != "energy.kinetic") columns.push_back({"", 0, energy});
  if (columns.empty())
    scene.sensitivities.origin.fail(
        "have no quantity: add output.probes, output.gauges, output.reactions: true or output.energy: true");
  return {model, std::move(columns)};
}

SensitivityWriter::SensitivityWriter(const std::filesystem::path& path, const Scene& scene, const FemModel& model,
                                     const Integrator& integrator, MotionSensitivity& sensitivity)
    : TableWriter(path, header_of("t [s]", sensitivity_quantities(scene, model), sensitivity.parameters())),
      quantities_(sensitivity_quantities(scene, model)),
      integrator_(integrator),
      sensitivity_(sensitivity) {}

State SensitivityWriter::slope(int i, double t) const {
  if (t <= start_) return sensitivity_.initial(i);
  State out;
  integrator_.interpolate_sensitivity(i, t, out);
  return out;
}

void SensitivityWriter::on_start(const ObservedState& observed) {
  TableWriter::on_start(observed);
  begin_at(observed.t());
  on_history(observed);
}

void SensitivityWriter::on_resume(const ObservedState& observed) {
  TableWriter::on_resume(observed);
  begin_at(observed.t());
}

void SensitivityWriter::on_history(const ObservedState& observed) {
  std::vector<Eigen::VectorXd> slopes;
  for (int i = 0; i < sensitivity_.count(); ++i)
    slopes.push_back(sensitivity_.derivative(i, observed.state(), slope(i, observed.t()), outputs_of(quantities_)));
  file_.row(row_of(observed.t(), slopes));
}

void SensitivityWriter::save(Archive& archive) {
  TableWriter::save(archive);
  for (int i = 0; i < sensitivity_.count(); ++i) {
    const State now = slope(i, reached_);
    archive.put(fmt::format("positions_{}", i), entries_of(now.q));
    archive.put(fmt::format("velocities_{}", i), entries_of(now.v));
  }
}

void SensitivityWriter::restore(const Archive& archive) {
  TableWriter::restore(archive);
  for (int i = 0; i < sensitivity_.count(); ++i) {
    State start = sensitivity_.initial(i);
    for (auto [name, values] : {std::pair("positions", &start.q), std::pair("velocities", &start.v)}) {
      const auto& saved = archive.numbers(fmt::format("{}_{}", name, i), static_cast<std::size_t>(values->size()));
      *values = Eigen::Map<const Vector>(saved.data(), values->size());
    }
    sensitivity_.set_initial(i, std::move(start));
  }
}

void write_sensitivities(const std::filesystem::path& path, const Scene& scene, const FemModel& model,
                         const EquilibriumSensitivity& sensitivity, const std::vector<SceneParameter>& parameters) {
  const ProbeColumns quantities = sensitivity_quantities(scene, model);
  CsvFile file(path, header_of("load_factor", quantities, parameters));
  std::vector<Eigen::VectorXd> slopes;
  for (const SceneParameter& parameter : parameters)
    slopes.push_back(sensitivity.derivatives(parameter, outputs_of(quantities)));
  file.begin();
  file.row(row_of(1, slopes));
}

}  // namespace orthodyn
