#include "lib/scene/quantity.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/spelling.h"
#include "lib/fem/nodal_fields.h"
#include "lib/scene/build.h"

namespace orthodyn {

namespace {

constexpr std::size_t kNearest = 5;  // names suggested in a message
constexpr const char* kMagnitude = "magnitude";

// The part of a name after `prefix` and a dot; "" if the name does not start with them.
std::string after(const std::string& name, const std::string& prefix) {
  return name.starts_with(prefix + ".") ? name.substr(prefix.size() + 1) : "";
}

// An output of the model, or its values at one node.
struct Source {
  OutputInfo info;
  int node = -1;

  std::vector<std::string> components() const {
    auto all = info.component_names;
    if (all.size() == 3 && all[0] == "x") all.push_back(kMagnitude);
    return all;
  }
};

std::vector<double> pick(const Source& source, const std::vector<double>& own, const std::string& component) {
  if (component.empty()) return own;
  if (component == kMagnitude) return {Eigen::Map<const Vec3>(own.data()).norm()};
  const auto& names = source.info.component_names;
  return {own[static_cast<std::size_t>(std::find(names.begin(), names.end(), component) - names.begin())]};
}

// `component`: one of the source's, or "".
Quantity make_quantity(const std::string& name, const Source& source, const std::string& component) {
  Quantity quantity{name, source.info.unit == "1" ? "" : source.info.unit};
  if (component.empty()) quantity.choices = source.info.component_names;
  quantity.values = [source, component](const ObservedState& observed) {
    auto own = source.node < 0 ? observed.evaluate(source.info.name)
                               : observed.evaluate_at(source.info.name, source.node, source.info.components);
    // For det_f.smallest, only the value is taken, without the element.
    own.resize(std::max<std::size_t>(source.info.component_names.size(), 1));
    return pick(source, own, component);
  };
  return quantity;
}

// All quantities of a scene by name, without components.
std::vector<std::pair<std::string, Source>> sources(const Scene& scene, const FemModel& model) {
  std::vector<std::pair<std::string, int>> nodes;
  for (const auto& [probe, p] : scene.output.probes) nodes.emplace_back(probe, p.node(model.parts().mesh));
  std::vector<std::pair<std::string, Source>> all;
  for (const auto& info : model.outputs()) {
    if (info.location == Location::global) all.push_back({info.name, {info}});
    if (info.location != Location::node) continue;
    for (const auto& [probe, node] : nodes) all.push_back({probe + "." + info.name, {info, node}});
  }
  return all;
}

// Adds names of gauges, as suggestions for misspelt names.
void add_gauges(const Scene& scene, std::vector<std::string>& known) {
  for (const auto& [name, gauge] : scene.output.gauges)
    for (const auto& [value, unit] : kGaugeValues) known.push_back(name + "." + value);
}

// The length or strain of a gauge, or both if `name` is that of a gauge; nullopt if it is neither.
std::optional<Quantity> find_gauge(const std::string& name, const Scene& scene, const FemModel& model) {
  for (const auto& [gauge_name, gauge] : scene.output.gauges) {
    const auto wanted = find_gauge_value(after(name, gauge_name));
    if (!wanted && name != gauge_name) continue;
    Quantity quantity{name, wanted == GaugeValue::length ? "m" : ""};
    if (!wanted)
      for (const auto& [value, unit] : kGaugeValues) quantity.choices.push_back(value);
    const auto chosen = [wanted](std::vector<double> all) {
      return wanted ? std::vector<double>{all[static_cast<std::size_t>(*wanted)]} : all;
    };
    const PlacedGauge placed(gauge, model.parts().mesh);
    quantity.values = [placed, chosen](const ObservedState& observed) { return chosen(placed.values(observed)); };
    quantity.values_on = [placed, chosen](const ObservedState& observed, const Mesh& mesh) {
      return chosen(placed.in(mesh).values(observed));
    };
    return quantity;
  }
  return std::nullopt;
}

// Adds names of extremes, as suggestions for misspelt names.
void add_extremes(std::vector<std::string>& known) {
  for (const OutputInfo& info : region_fields()) {
    if (info.component_names.empty()) known.push_back(info.name + ".largest");
    for (const auto& component : info.component_names) known.push_back(info.name + "." + component + ".largest");
  }
}

}  // namespace

std::string Quantity::ask_for_component() const {
  return fmt::format("'{}' has several components: choose .{}{}", name, fmt::join(choices, ", ."),
                     is_vector() && choices[0] == "x" ? std::string(" or .") + kMagnitude : "");
}

Quantity find_quantity(const std::string& name, const Scene& scene, const FemModel& model,
                       const SourceLocation& origin) {
  if (name == kEnergyBalance) return {name, "J"};
  if (const auto extreme = find_extreme(name, model, origin))
    return {name, unit_of_extreme(name), {}, [find = *extreme](const ObservedState& observed) {
              return std::vector<double>{find(observed).value};
            }};
  if (auto gauge = find_gauge(name, scene, model)) return *std::move(gauge);
  std::vector<std::string> known{kEnergyBalance};
  for (const auto& [source_name, source] : sources(scene, model)) {
    const std::string rest = after(name, source_name);
    const auto components = source.components();
    if (name == source_name || std::find(components.begin(), components.end(), rest) != components.end()) {
      if (source.node >= 0) require_field_at(source.info.name, source.node, model, origin);
      return make_quantity(name, source, rest);
    }
    known.push_back(source_name);
    for (const auto& component : components) known.push_back(source_name + "." + component);
  }
  add_gauges(scene, known);
  add_extremes(known);
  origin.fail(
      fmt::format("unknown quantity '{}'{} The nearest are {}. Use a probe of the scene with a field and a component "
                  "(tip.displacement.z, see `orthodyn list fields`), a gauge (NAME.strain), or a quantity of the whole "
                  "body (`orthodyn list quantities`)",
                  name, did_you_mean(name, known, "."), join(nearest_names(name, known, kNearest))));
}

}  // namespace orthodyn
