#include "lib/simulation/output/curves.h"

#include <fmt/format.h>

#include <algorithm>

namespace orthodyn {

StepWriter::StepWriter(const std::filesystem::path& path)
    : TableWriter(path, {"t [s]", "h [s]", "order", "newton_iterations", "rejected"}) {}

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

std::vector<std::string> probe_header(const ProbeColumns& columns, const std::string& axis) {
  std::vector<std::string> header{axis};
  for (const auto& [name, unit] : columns.names_and_units()) header.push_back(fmt::format("{} [{}]", name, unit));
  return header;
}

}  // namespace

ProbeColumns::ProbeColumns(const Model& model, std::vector<ProbeColumn> columns) : columns_(std::move(columns)) {
  for (auto& column : columns_) {
    if (column.gauge) {
      for (const auto& [value, unit] : kGaugeValues) names_and_units_.emplace_back(column.name + "." + value, unit);
      continue;
    }
    const OutputInfo info = info_of(model, column.field);
    column.components = info.components;
    column.at_node = info.location == Location::node;
    const std::string whole = (column.name.empty() ? "" : column.name + ".") + column.field;
    for (int c = 0; c < info.components; ++c)
      names_and_units_.emplace_back(
          info.component_names.empty() ? whole : whole + "." + info.component_names[static_cast<std::size_t>(c)],
          info.unit);
  }
}

std::vector<double> ProbeColumns::values(const ObservedState& observed) const { return values(observed, nullptr); }

std::vector<double> ProbeColumns::values_on(const Mesh& mesh, const ObservedState& observed) const {
  return values(observed, &mesh);
}

// `mesh`: null for that of the model of the columns.
std::vector<double> ProbeColumns::values(const ObservedState& observed, const Mesh* mesh) const {
  const auto values_of = [&](const ProbeColumn& column) {
    if (column.gauge) return mesh ? column.gauge->in(*mesh).values(observed) : column.gauge->values(observed);
    return column.at_node ? observed.evaluate_at(column.field, column.node, column.components)
                          : observed.evaluate(column.field);
  };
  std::vector<double> all;
  for (const auto& column : columns_) {
    const auto values = values_of(column);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

ProbeWriter::ProbeWriter(const std::filesystem::path& path, const Model& model, std::vector<ProbeColumn> columns,
                         const std::string& axis)
    : ProbeWriter(path, ProbeColumns(model, std::move(columns)), axis) {}

ProbeWriter::ProbeWriter(const std::filesystem::path& path, ProbeColumns columns, const std::string& axis)
    : TableWriter(path, probe_header(columns, axis)), columns_(std::move(columns)) {}

void ProbeWriter::on_start(const ObservedState& observed) {
  TableWriter::on_start(observed);
  on_history(observed);
}

void ProbeWriter::on_history(const ObservedState& observed) {
  std::vector<double> row{observed.t()};
  const auto values = columns_.values(observed);
  row.insert(row.end(), values.begin(), values.end());
  file_.row(row);
}

EventWriter::EventWriter(const std::filesystem::path& path, EventFinder& finder)
    : TableWriter(path, {"t [s]", "event", "value", "direction"}), finder_(finder) {}

void EventWriter::on_event(const Crossing& crossing) {
  file_.append(fmt::format("{},{},{},{}\n", crossing.state.t, crossing.event->name, crossing.event->value,
                           crossing.upward ? "up" : "down"));
}

void EventWriter::save(Archive& archive) {
  TableWriter::save(archive);
  finder_.save(archive);
}

void EventWriter::restore(const Archive& archive) {
  TableWriter::restore(archive);
  finder_.restore(archive);
}

}  // namespace orthodyn
