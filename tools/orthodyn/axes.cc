#include "tools/orthodyn/axes.h"

#include <fmt/format.h>

#include "lib/simulation/frames.h"
#include "tools/orthodyn/draw.h"

namespace orthodyn {

namespace {

State at_rest(const FemModel& model) {
  const Vector zero = Vector::Zero(model.num_dofs());
  return {0, zero, zero};
}

}  // namespace

void write_axes(const Setup& setup, const std::filesystem::path& folder) {
  const FemModel& model = *setup.built.model;
  State rest = at_rest(model);
  std::vector<VtuField> fields;
  for (const int axis : {1, 2, 3})
    fields.push_back({fmt::format("axis_{}", axis), Location::cell, 3,
                      model.evaluate(fmt::format("material_axis_{}", axis), rest)});
  fields.push_back({"region", Location::cell, 1, model.evaluate("region", rest)});
  const auto file = folder / "axes.vtu";
  write_vtu(file, model.geometry(), fields);
  fmt::print("axes    {}\n", file.string());
  draw_axes(file);
}

void print_axes(const Setup& setup) {
  fmt::print("axes\n");
  const Config regions = setup.config.at("regions");
  for (const auto& [name, region] : setup.scene.regions)
    fmt::print("  region {}: {}, {}\n", name, regions.at(name).at("axes").at("type").text(),
               region.axes->uniform() ? "one for all elements" : "per element");
}

}  // namespace orthodyn
