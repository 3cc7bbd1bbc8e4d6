#include "lib/study/converge/convergence.h"

#include <fmt/format.h>

#include <utility>

#include "lib/scene/build.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/harmonic/response_columns.h"
#include "lib/simulation/run/fingerprints.h"
#include "lib/simulation/run/scene_file.h"
#include "lib/study/inputs/refined_mesh.h"

namespace orthodyn::study::converge {

namespace {

std::string name_of(TimeReduction take, const std::string& quantity) {
  return take == TimeReduction::end ? quantity : fmt::format("{} of {}", Value<TimeReduction>::yaml(take), quantity);
}

void add(Named<WantedMetric>& metrics, WantedMetric metric, std::string name) {
  for (const auto& [other, m] : metrics)
    if (other == name) return;
  metric.origin.where = name;
  metrics.emplace_back(std::move(name), std::move(metric));
}

void add(Named<WantedMetric>& metrics, TimeReduction take, const std::string& quantity) {
  add(metrics, {.quantity = quantity, .take = take}, name_of(take, quantity));
}

// `rest`: "tip.displacement.z" or "tip.displacement.z at 120 Hz".
void add_response(Named<WantedMetric>& metrics, const std::string& rest, ResponseMetric response,
                  const Config& origin) {
  const auto at = rest.find(" at ");
  WantedMetric metric{.quantity = rest.substr(0, at), .response = response};
  if (at != std::string::npos)
    metric.frequency = read_number(Config::from_text(rest.substr(at + 4), origin.file()), {.unit = "Hz"});
  check_response_metric(response, metric.frequency, origin);
  add(metrics, metric, response_title(response, metric.quantity, metric.frequency));
}

// "max of tip.displacement.z", in a harmonic analysis "amplitude of tip.displacement.z at 120 Hz"
void add_named(Named<WantedMetric>& metrics, const std::string& text, bool is_harmonic) {
  const auto of = text.find(" of ");
  if (of == std::string::npos) return add(metrics, TimeReduction::end, text);
  const Config take = Config::from_text(text.substr(0, of), "--quantity " + text);
  if (is_harmonic) add_response(metrics, text.substr(of + 4), Value<ResponseMetric>::read(take, {}), take);
  else add(metrics, Value<TimeReduction>::read(take, {}), text.substr(of + 4));
}

// Default metrics: the scene's expectations, otherwise the displacements of its probes, otherwise its elastic energy.
void add_defaults(Named<WantedMetric>& metrics, const Scene& scene, const FemModel& model) {
  const bool is_static = scene.is_static();
  for (const Expectation& e : scene.expect)
    if (e.is_eigenvalue()) add(metrics, {.mode = e.mode, .buckling = e.buckling}, e.title());
    else if (e.quantity != kEnergyBalance)
      add(metrics,
          {.quantity = e.quantity,
           .take = e.take,
           .at = e.at,
           .of = e.of,
           .response = e.response,
           .frequency = e.frequency},
          e.title());
  if (!metrics.empty()) return;
  if (scene.harmonic) {
    for (const ResponseColumn& column : response_columns(scene, model))
      add(metrics, {.quantity = column.name, .response = ResponseMetric::peak}, "peak of " + column.name);
    return;
  }
  for (const auto& [name, probe] : scene.output.probes) {
    if (!is_static) add(metrics, TimeReduction::max, name + ".displacement.magnitude");
    add(metrics, TimeReduction::end, name + ".displacement.magnitude");
  }
  for (const auto& [name, gauge] : scene.output.gauges) {
    if (!is_static) add(metrics, TimeReduction::max, name + ".strain");
    add(metrics, TimeReduction::end, name + ".strain");
  }
  if (metrics.empty()) add(metrics, is_static ? TimeReduction::end : TimeReduction::max, "energy.elastic");
}

Level level_of(const Convergence& wanted, int order, int level) {
  Config config = read_scene_file(wanted.file, {.set = wanted.set}).resolving();
  config.set("mesh.order", static_cast<long>(order));
  refine_mesh(config, level);
  read_scene(config);
  return {order, level, point_scene(config, fmt::format("order {}, level {}", order, level + 1))};
}

}  // namespace

Design design_of(const Convergence& wanted) {
  const Config config = read_scene_file(wanted.file, {.set = wanted.set});
  const Scene scene = read_scene(config);
  Design design;
  for (const auto& text : wanted.quantities) add_named(design.metrics, text, scene.harmonic.has_value());
  const BuiltScene built = build(scene);
  if (wanted.quantities.empty() && wanted.modes == 0) add_defaults(design.metrics, scene, *built.model);
  for (int mode = 1; mode <= wanted.modes; ++mode)
    add(design.metrics, {.mode = mode}, fmt::format("frequency of mode {}", mode));
  for (auto& [name, metric] : design.metrics) {
    if (metric.quantity.empty()) continue;
    if (scene.harmonic) {
      find_column(response_columns(scene, *built.model), metric.quantity, metric.origin);
      continue;
    }
    if (scene.is_static() && metric.take != TimeReduction::end)
      metric.origin.fail("a static analysis has only the value in equilibrium: remove '... of'");
    const Quantity q = find_quantity(metric.quantity, scene, *built.model, metric.origin);
    if (q.components() > 1 && !(q.is_vector() && metric.take == TimeReduction::drift))
      metric.origin.fail(q.ask_for_component());
  }
  for (const int order : wanted.orders)
    for (int level = 0; level < wanted.levels; ++level) design.levels.push_back(level_of(wanted, order, level));
  return design;
}

EvaluationInput input_of(const Convergence& wanted, const Design& design) {
  return {.metrics = design.metrics, .seconds = wanted.limits.seconds, .code = code_fingerprint(), .mesh_error = true};
}

}  // namespace orthodyn::study::converge
