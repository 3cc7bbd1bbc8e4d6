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

std::vector<ProbeColumn> with_components(const Model& model, std::vector<ProbeColumn> columns) {
  for (auto& column : columns) {
    const OutputInfo info = info_of(model, column.field);
    column.components = info.components;
    column.at_node = info.location == Location::node;
  }
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
    : TableWriter(path, probe_header(model, columns, axis)), columns_(with_components(model, std::move(columns))) {}

void ProbeWriter::on_start(const ObservedState& observed) {
  TableWriter::on_start(observed);
  on_history(observed);
}

void ProbeWriter::on_history(const ObservedState& observed) {
  std::vector<double> row{observed.t()};
  for (const auto& column : columns_) {
    const auto values = column.at_node ? observed.evaluate_at(column.field, column.node, column.components)
                                       : observed.evaluate(column.field);
    row.insert(row.end(), values.begin(), values.end());
  }
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
