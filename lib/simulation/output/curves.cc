#include "lib/simulation/output/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace orthodyn {

EnergyWriter::EnergyWriter(const std::filesystem::path& path, const Model& model, const Integrator& integrator,
                           EnergyTimes times)
    : EnergyMeter(model, integrator, times),
      file_(path, {"t [s]", "kinetic [J]", "elastic [J]", "gravitational [J]", "dissipated [J]", "loads [J]",
                   "balance [J]"}) {}

void EnergyWriter::on_start(const ObservedState& observed) {
  EnergyMeter::on_start(observed);
  file_.begin();
  write(observed.t());
}

void EnergyWriter::on_history(const ObservedState& observed) {
  EnergyMeter::on_output(observed);
  write(observed.t());
}

void EnergyWriter::save(Archive& archive) {
  EnergyMeter::save(archive);
  file_.save(archive);
}

void EnergyWriter::restore(const Archive& archive) {
  EnergyMeter::restore(archive);
  file_.restore(archive);
}

void EnergyWriter::write(double t) {
  const auto& e = last();
  file_.row({t, e.kinetic, e.elastic, e.gravitational, e.dissipated, e.loads, change()});
}

MomentumWriter::MomentumWriter(const std::filesystem::path& path)
    : file_(path, {"t [s]", "linear.x [kg m/s]", "linear.y [kg m/s]", "linear.z [kg m/s]", "angular.x [kg m^2/s]",
                   "angular.y [kg m^2/s]", "angular.z [kg m^2/s]"}) {}

void MomentumWriter::on_start(const ObservedState& observed) {
  MomentumMeter::on_start(observed);
  file_.begin();
  write(observed.t());
}

void MomentumWriter::on_history(const ObservedState& observed) {
  MomentumMeter::on_output(observed);
  write(observed.t());
}

void MomentumWriter::save(Archive& archive) {
  MomentumMeter::save(archive);
  file_.save(archive);
}

void MomentumWriter::restore(const Archive& archive) {
  MomentumMeter::restore(archive);
  file_.restore(archive);
}

void MomentumWriter::write(double t) {
  const Vec3 &p = linear(), &l = angular();
  file_.row({t, p[0], p[1], p[2], l[0], l[1], l[2]});
}

StepWriter::StepWriter(const std::filesystem::path& path)
    : file_(path, {"t [s]", "h [s]", "order", "newton_iterations", "rejected"}) {}

void StepWriter::on_step(const StepInfo& info, const ObservedState&, const Integrator& integrator) {
  const Statistics now = integrator.statistics();
  file_.row({info.t, info.h, static_cast<double>(info.order),
             static_cast<double>(now.newton_iterations - before_.newton_iterations),
             static_cast<double>(now.rejected_steps - before_.rejected_steps)});
  before_ = now;
}

namespace {

OutputInfo info_of(const Model& model, const std::string& field) {
  const auto all = model.outputs();
  return *std::find_if(all.begin(), all.end(), [&](const auto& info) { return info.name == field; });
}

std::vector<ProbeColumn> with_components(const Model& model, std::vector<ProbeColumn> columns) {
  for (auto& column : columns) column.components = info_of(model, column.field).components;
  return columns;
}

std::vector<std::string> probe_header(const Model& model, const std::vector<ProbeColumn>& columns,
                                      const std::string& t) {
  std::vector<std::string> header{t};
  for (const auto& column : columns) {
    const auto info = info_of(model, column.field);
    for (int c = 0; c < info.components; ++c)
      header.push_back(fmt::format(
          "{}{}{} [{}]", column.name.empty() ? "" : column.name + ".", column.field,
          info.component_names.empty() ? "" : "." + info.component_names[static_cast<std::size_t>(c)], info.unit));
  }
  return header;
}

}  // namespace

ProbeWriter::ProbeWriter(const std::filesystem::path& path, const Model& model, std::vector<ProbeColumn> columns,
                         const std::string& axis)
    : columns_(with_components(model, std::move(columns))), file_(path, probe_header(model, columns_, axis)) {}

void ProbeWriter::on_start(const ObservedState& observed) {
  file_.begin();
  record(observed);
}

void ProbeWriter::record(const ObservedState& observed) {
  std::map<std::string, std::vector<double>> fields;
  std::vector<double> row{observed.t()};
  for (const auto& column : columns_) {
    auto [it, missing] = fields.try_emplace(column.field);
    if (missing) it->second = observed.evaluate(column.field);
    const auto first = it->second.begin() + std::ptrdiff_t{column.components} * column.node;
    row.insert(row.end(), first, first + column.components);
  }
  file_.row(row);
}

}  // namespace orthodyn
