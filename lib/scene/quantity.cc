#include "lib/scene/quantity.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/words.h"
#include "lib/scene/build.h"

namespace orthodyn {

namespace {

constexpr std::size_t kNearest = 5;  // names in a message
constexpr std::array kComponents{"x", "y", "z", "magnitude"};

// Where a name starts with `prefix` and a dot: what follows, else "".
std::string after(const std::string& name, const std::string& prefix) {
  return name.starts_with(prefix + ".") ? name.substr(prefix.size() + 1) : "";
}

std::vector<double> pick(const std::vector<double>& vector, const std::string& component) {
  if (component.empty()) return vector;
  if (component == "magnitude") return {Eigen::Map<const Vec3>(vector.data()).norm()};
  return {vector[static_cast<std::size_t>(component[0] - 'x')]};
}

// Fields of one output: all of it, or of one node.
struct Source {
  std::string output;
  int components, node = -1;
  std::string unit;
};

// `rest` is what follows the source's name: "", or a component of a vector.
bool is_component_of(const std::string& rest, const Source& source) {
  if (rest.empty()) return true;
  return source.components == 3 && std::find(kComponents.begin(), kComponents.end(), rest) != kComponents.end();
}

Quantity make_quantity(const std::string& name, const Source& source, const std::string& component) {
  Quantity quantity{name, source.unit, source.components == 3 && component.empty() ? 3 : 1, {}};
  quantity.values = [source, component](const ObservedState& observed) {
    const auto all = observed.evaluate(source.output);
    const auto first = source.node < 0 ? 0 : static_cast<std::size_t>(source.node * source.components);
    const auto count = source.components == 3 ? 3u : 1u;  // of det_f.smallest the value, not the element
    return pick({all.begin() + static_cast<std::ptrdiff_t>(first),
                 all.begin() + static_cast<std::ptrdiff_t>(first + count)},
                component);
  };
  return quantity;
}

// Every source that the scene has, by name.
std::vector<std::pair<std::string, Source>> sources(const Scene& scene, const FemModel& model) {
  std::vector<std::pair<std::string, Source>> all;
  for (const auto& info : model.outputs()) {
    if (info.location == Location::global) all.push_back({info.name, {info.name, info.components, -1, info.unit}});
    if (info.location != Location::node) continue;
    for (const auto& [probe, p] : scene.output.probes)
      all.push_back({probe + "." + info.name,
                     {info.name, info.components, nearest_node(model.parts().mesh, p.at), info.unit}});
  }
  return all;
}

}  // namespace

Quantity find_quantity(const std::string& name, const Scene& scene, const FemModel& model, const Origin& origin) {
  if (name == kEnergyBalance) return {name, "J", 1, {}};
  std::vector<std::string> known{kEnergyBalance};
  for (const auto& [source_name, source] : sources(scene, model)) {
    const std::string rest = after(name, source_name);
    if (name == source_name || (!rest.empty() && is_component_of(rest, source)))
      return make_quantity(name, source, rest);
    known.push_back(source_name);
    if (source.components != 3) continue;
    for (const char* component : kComponents) known.push_back(source_name + "." + component);
  }
  origin.fail(fmt::format("unknown quantity '{}'{} The nearest are {}. Take a probe of the scene with a field and a "
                          "component (tip.displacement.z, see `orthodyn list fields`), or a quantity of the whole body "
                          "(`orthodyn list quantities`)",
                          name, did_you_mean(name, known, "."), join(nearest_names(name, known, kNearest))));
}

}  // namespace orthodyn
