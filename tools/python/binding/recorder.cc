#include "tools/python/binding/recorder.h"

#include <algorithm>
#include <span>

#include "tools/python/binding/arrays.h"

namespace orthodyn::python {
namespace {

// A row of nodes per cell; -1 after the nodes of smaller cells.
py::array_t<int> table_of(const Cells& cells) {
  std::size_t width = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) width = std::max(width, cells[c].size());
  std::vector<int> table(width * cells.size(), -1);
  for (std::size_t c = 0; c < cells.size(); ++c) std::ranges::copy(cells[c], &table[width * c]);
  return array_of(std::move(table), {static_cast<py::ssize_t>(cells.size()), static_cast<py::ssize_t>(width)});
}

}  // namespace

Recorder::Recorder(const OutputSource& source, const std::vector<std::string>& fields) : geometry_(source.geometry()) {
  const std::vector<OutputInfo> outputs = source.outputs();
  for (const std::string& name : fields) {
    const auto info = std::find_if(outputs.begin(), outputs.end(), [&](const OutputInfo& o) { return o.name == name; });
    if (info != outputs.end() && info->location != Location::global) fields_.push_back({*info, {}});
  }
}

void Recorder::record(const ObservedState& observed) {
  times_.push_back(observed.t());
  for (Field& field : fields_) {
    const std::vector<double> values = observed.evaluate(field.info.name);
    field.values.insert(field.values.end(), values.begin(), values.end());
    observed.share(field.info.name, std::span(field.values).last(values.size()));
  }
}

py::dict Recorder::take() {
  py::dict out;
  if (!complete_) return out;
  const auto frames = static_cast<py::ssize_t>(times_.size());
  const auto nodes = static_cast<py::ssize_t>(geometry_.points.size());
  std::vector<double> points;
  for (const Vec3& x : geometry_.points) points.insert(points.end(), x.data(), x.data() + 3);
  const auto cells = static_cast<py::ssize_t>(geometry_.cells.size());
  out["times"] = array_of(std::move(times_));
  out["points"] = array_of(std::move(points), {nodes, 3});
  std::vector<int> types;
  for (const CellShape shape : geometry_.cells.shapes()) types.push_back(topology(shape).vtk_type);
  out["cells"] = table_of(geometry_.cells);
  out["cell_types"] = array_of(std::move(types));
  py::dict fields;
  py::list of_cells;
  for (Field& field : fields_) {
    const auto places = field.info.location == Location::node ? nodes : cells;
    if (field.info.location == Location::cell) of_cells.append(field.info.name);
    fields[field.info.name.c_str()] = array_of(std::move(field.values), {frames, places, field.info.components});
  }
  out["fields"] = fields;
  out["cell_fields"] = of_cells;
  return out;
}

}  // namespace orthodyn::python
