// Extremes of the fields of stress and strain over the nodes of a region.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/fem/fem_model.h"
#include "lib/fem/nodal_figures.h"
#include "lib/scene/quantity.h"

namespace orthodyn {

namespace {

bool needs_strength(const std::string& field) {
  const auto& all = nodal_figures();
  return std::any_of(all.begin(), all.end(), [&](const auto& f) { return f.name == field && f.needs_strength; });
}

// A field of one region, or of all of them where `region` is "".
struct FieldOfRegion {
  std::string region, field;
  std::size_t component = 0, components = 1;

  std::string name() const { return region.empty() ? field : region + "." + field; }
};

std::vector<std::string> region_names(const FemModel& model) {
  std::vector<std::string> names{""};
  for (const auto& term : model.parts().elastic) names.push_back(term->region());
  return names;
}

std::optional<FieldOfRegion> read_field(const std::string& name, const FemModel& model) {
  for (const std::string& region : region_names(model))
    for (const OutputInfo& info : region_fields()) {
      FieldOfRegion found{region, info.name, 0, static_cast<std::size_t>(info.components)};
      if (info.component_names.empty() && name == found.name()) return found;
      for (std::size_t c = 0; c < info.component_names.size(); ++c)
        if (name == found.name() + "." + info.component_names[c]) return found.component = c, found;
    }
  return std::nullopt;
}

}  // namespace

void require_strengths(const std::string& field, const std::string& region, const FemModel& model,
                       const Origin& origin) {
  if (!needs_strength(field)) return;
  for (const auto& term : model.parts().elastic)
    if ((region.empty() || term->region() == region) && term->definition().strength) return;
  origin.fail(fmt::format("'{}' needs the strengths of {}: give its material strength: {{tension: [...], compression: "
                          "[...], shear: [...]}} in Pa, or take a preset that has them (`orthodyn list presets`)",
                          field, region.empty() ? "a material" : "the material of region " + region));
}

std::string unit_of_extreme(const std::string& name) {
  for (const OutputInfo& info : region_fields())
    if (name.starts_with(info.name + ".") || name.find("." + info.name + ".") != std::string::npos)
      return info.unit == "1" ? "" : info.unit;
  return "";
}

std::optional<FindExtreme> find_extreme(const std::string& name, const FemModel& model, const Origin& origin) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos) return std::nullopt;
  const std::string which = name.substr(dot + 1);
  if (which != "largest" && which != "smallest") return std::nullopt;
  const auto field = read_field(name.substr(0, dot), model);
  if (!field) return std::nullopt;
  require_strengths(field->field, field->region, model, origin);
  const double sign = which == "largest" ? 1 : -1;
  return [field = *field, sign](const ObservedState& observed) {
    const auto values = observed.evaluate(field.name());
    Extreme extreme{std::numeric_limits<double>::quiet_NaN(), -1};
    for (std::size_t k = field.component; k < values.size(); k += field.components) {
      if (std::isnan(values[k]) || !(extreme.node < 0 || sign * values[k] > sign * extreme.value)) continue;
      extreme = {values[k], static_cast<int>(k / field.components)};
    }
    return extreme;
  };
}

}  // namespace orthodyn
