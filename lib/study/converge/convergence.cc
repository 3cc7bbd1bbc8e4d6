#include "lib/study/converge/convergence.h"

#include <fmt/format.h>

#include <utility>

#include "lib/scene/build.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/run/fingerprints.h"
#include "lib/simulation/run/scene_file.h"

namespace orthodyn::study::converge {

namespace {

std::string name_of(Take take, const std::string& quantity) {
  return take == Take::end ? quantity : fmt::format("{} of {}", Value<Take>::yaml(take), quantity);
}

void add(Named<WantedMetric>& metrics, WantedMetric metric, std::string name) {
  for (const auto& [other, f] : metrics)
    if (other == name) return;
  metric.origin.where = name;
  metrics.emplace_back(std::move(name), std::move(metric));
}

void add(Named<WantedMetric>& metrics, Take take, const std::string& quantity) {
  add(metrics, {.quantity = quantity, .take = take}, name_of(take, quantity));
}

// "max of tip.displacement.z"
void add_named(Named<WantedMetric>& metrics, const std::string& text) {
  const auto of = text.find(" of ");
  if (of == std::string::npos) return add(metrics, Take::end, text);
  const Config take = Config::from_text(text.substr(0, of), "--quantity " + text);
  add(metrics, Value<Take>::read(take, {}), text.substr(of + 4));
}

// What the scene expects, or else how far its probes move, or else its energy.
void add_usual(Named<WantedMetric>& metrics, const Scene& scene) {
  const bool is_static = scene.is_static();
  for (const Expectation& e : scene.expect)
    if (e.is_eigenvalue()) add(metrics, {.mode = e.mode, .buckling = e.buckling}, e.title());
    else if (e.quantity != kEnergyBalance)
      add(metrics, {.quantity = e.quantity, .take = e.take, .at = e.at, .of = e.of}, e.title());
  if (!metrics.empty()) return;
  for (const auto& [name, probe] : scene.output.probes) {
    if (!is_static) add(metrics, Take::max, name + ".displacement.magnitude");
    add(metrics, Take::end, name + ".displacement.magnitude");
  }
  if (metrics.empty()) add(metrics, is_static ? Take::end : Take::max, "energy.elastic");
}

Level level_of(const Convergence& wanted, int order, int level) {
  Config config = read_scene_file(wanted.file, {.set = wanted.set}).resolving();
  const Config mesh = config.at("mesh");
  config.set("mesh.order", static_cast<long>(order));
  const int factor = 1 << level;
  if (mesh.has("cells")) {
    for (std::size_t i = 0; i < mesh.at("cells").size(); ++i)
      config.set(fmt::format("mesh.cells.{}", i), mesh.at("cells").at(i).integer() * factor);
  } else if (mesh.has("file")) {
    const long own = mesh.has("refine") ? mesh.at("refine").integer() : 0;
    config.set("mesh.refine", own + level);
  } else {
    mesh.fail("has neither cells nor a file, and cannot be refined");
  }
  read_scene(config);
  return {order, level, point_scene(config, fmt::format("order {}, level {}", order, level + 1))};
}

}  // namespace

Design design_of(const Convergence& wanted) {
  const Config config = read_scene_file(wanted.file, {.set = wanted.set});
  const Scene scene = read_scene(config);
  Design design;
  for (const auto& text : wanted.quantities) add_named(design.metrics, text);
  if (wanted.quantities.empty() && wanted.modes == 0) add_usual(design.metrics, scene);
  for (int mode = 1; mode <= wanted.modes; ++mode)
    add(design.metrics, {.mode = mode}, fmt::format("frequency of mode {}", mode));
  const BuiltScene built = build(scene);
  for (auto& [name, metric] : design.metrics) {
    if (metric.quantity.empty()) continue;
    if (scene.is_static() && metric.take != Take::end)
      metric.origin.fail("a static analysis knows only values in equilibrium: leave out 'max of' and the like");
    const Quantity q = find_quantity(metric.quantity, scene, *built.model, metric.origin);
    if (q.components() > 1 && !(q.is_vector() && metric.take == Take::drift)) metric.origin.fail(q.ask_for_component());
  }
  for (const int order : wanted.orders)
    for (int level = 0; level < wanted.levels; ++level) design.levels.push_back(level_of(wanted, order, level));
  return design;
}

EvaluationInput input_of(const Convergence& wanted, const Design& design) {
  return {.metrics = design.metrics, .seconds = wanted.limits.seconds, .code = code_fingerprint(), .mesh_error = true};
}

}  // namespace orthodyn::study::converge
