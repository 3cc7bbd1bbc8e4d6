#include "lib/study/compare/measurement_result.h"

#include <algorithm>

#include "lib/simulation/output/json.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::compare {

namespace {

Json to_json(const ErrorNorms& e) {
  return {{"final", finite_or_null(e.final)}, {"l2", finite_or_null(e.l2)}, {"max", finite_or_null(e.max)}};
}

ErrorNorms norms_from(const Json& json) {
  return {number_or_nan(json.at("final")), number_or_nan(json.at("l2")), number_or_nan(json.at("max"))};
}

Json to_json(const ModelSize& m) {
  return {{"unknowns", m.unknowns}, {"elements", m.elements}, {"nodes", m.nodes},
          {"start", m.start},       {"end", m.end},           {"order", m.order}};
}

ModelSize model_from(const Json& json) {
  return {json.at("unknowns"), json.at("elements"), json.at("nodes"),
          json.at("start"),    json.at("end"),      json.at("order")};
}

Json to_json(const Spread& s) { return {{"median", s.median}, {"min", s.min}, {"max", s.max}}; }

Spread spread_from(const Json& json) { return {json.at("median"), json.at("min"), json.at("max")}; }

Json to_json(const Drift& d) {
  return {{"energy", finite_or_null(d.energy)},
          {"linear_momentum", finite_or_null(d.linear_momentum)},
          {"angular_momentum", finite_or_null(d.angular_momentum)}};
}

Drift drift_from(const Json& json) {
  return {number_or_nan(json.at("energy")), number_or_nan(json.at("linear_momentum")),
          number_or_nan(json.at("angular_momentum"))};
}

Json to_json(const EnergyChange& c) { return {{"t", c.times}, {"energy", numbers_json(c.changes)}}; }

EnergyChange energy_change_from(const Json& json) {
  return {numbers_from(json.at("t")), numbers_from(json.at("energy"))};
}

constexpr const char* kind_word(MeasurementResult::Kind kind) {
  return kind == MeasurementResult::Kind::exact ? "exact" : "computed";
}

void put_timing(Json& json, const Timing& timing, const Statistics& statistics) {
  json["repeats"] = timing.repeats;
  json["wall"] = to_json(timing.wall);
  json["cpu"] = to_json(timing.cpu);
  json["statistics"] = to_json(statistics);
  json["peak_memory_bytes"] = timing.peak_memory;
}

// Reads the value of a key, if it is there.
template <class T, class Read>
void take(const Json& json, const char* key, std::optional<T>& value, const Read& read) {
  if (json.contains(key)) value = read(json.at(key));
}

}  // namespace

Json to_json(const TrajectoryErrors& errors) {
  Json probes = Json::object(), quantities = Json::object();
  for (const auto& [name, e] : errors.probes) probes[name] = to_json(e);
  for (const auto& [name, e] : errors.quantities) quantities[name] = to_json(e);
  return {{"displacement", to_json(errors.displacement)},
          {"velocity", to_json(errors.velocity)},
          {"probes", probes},
          {"quantities", quantities},
          {"phase", finite_or_null(errors.phase)}};
}

TrajectoryErrors errors_from(const Json& json) {
  TrajectoryErrors errors{
      norms_from(json.at("displacement")), norms_from(json.at("velocity")), {}, {}, number_or_nan(json.at("phase"))};
  for (const auto& [name, e] : json.at("probes").items()) errors.probes.emplace_back(name, norms_from(e));
  for (const auto& [name, e] : json.at("quantities").items()) errors.quantities.emplace_back(name, norms_from(e));
  return errors;
}

Json to_json(const TrajectoryScales& scales) {
  Json probes = Json::object(), quantities = Json::object();
  for (const auto& [name, length] : scales.probes) probes[name] = finite_or_null(length);
  for (const auto& [name, size] : scales.quantities) quantities[name] = finite_or_null(size);
  return {{"displacement", finite_or_null(scales.displacement)},
          {"velocity", finite_or_null(scales.velocity)},
          {"probes", probes},
          {"quantities", quantities},
          {"dominant_frequency", finite_or_null(scales.dominant_frequency)}};
}

TrajectoryScales scales_from(const Json& json) {
  TrajectoryScales scales{number_or_nan(json.at("displacement")),
                          number_or_nan(json.at("velocity")),
                          {},
                          {},
                          number_or_nan(json.at("dominant_frequency"))};
  for (const auto& [name, length] : json.at("probes").items()) scales.probes.emplace_back(name, number_or_nan(length));
  for (const auto& [name, size] : json.at("quantities").items())
    scales.quantities.emplace_back(name, number_or_nan(size));
  return scales;
}

Json to_json(const MeasurementInput& i) {
  return {{"repeats", i.repeats},
          {"samples", i.samples},
          {"seconds", i.seconds},
          {"reference", i.reference},
          {"keep_trajectory", i.keep_trajectory},
          {"exact_if_possible", i.exact_if_possible},
          {"at_probes", i.at_probes},
          {"quantities", i.quantities},
          {"code", i.code}};
}

MeasurementInput measurement_input_from(const Json& json) {
  return {.repeats = json.at("repeats"),
          .samples = json.at("samples"),
          .seconds = json.at("seconds"),
          .reference = json.at("reference"),
          .keep_trajectory = json.at("keep_trajectory"),
          .exact_if_possible = json.at("exact_if_possible"),
          .at_probes = json.at("at_probes"),
          .quantities = json.at("quantities"),
          .code = json.at("code")};
}

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = values.size();
  const double median = n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
  return {median, values.front(), values.back()};
}

Json to_json(const MeasurementResult& r) {
  Json json{{"status", r.failure ? "failed" : "completed"}};
  if (r.model) {
    json["model"] = to_json(*r.model);
    json["decisions"] = Json::object();
    for (const auto& [key, value] : r.decisions) json["decisions"][key] = value;
  }
  if (r.time_reached) json["time_reached"] = *r.time_reached;
  if (r.factor_bytes) json["factor_bytes"] = *r.factor_bytes;
  if (r.timing) put_timing(json, *r.timing, r.statistics.value_or(Statistics{}));
  if (r.kind) json["kind"] = kind_word(*r.kind);
  if (r.own_errors) json["own_errors"] = to_json(*r.own_errors);
  if (r.kind && r.statistics) json["statistics"] = to_json(*r.statistics);
  if (r.mesh_error) json["mesh_error"] = *r.mesh_error;
  if (r.seconds) json["seconds"] = *r.seconds;
  if (r.drift) json["drift"] = to_json(*r.drift);
  if (r.drift_over_time) json["drift_over_time"] = to_json(*r.drift_over_time);
  if (r.smallest_det_f) json["smallest_det_f"] = finite_or_null(*r.smallest_det_f);
  if (r.scales) json["scales"] = to_json(*r.scales);
  if (r.errors) json["errors"] = to_json(*r.errors);
  if (r.failure) json["reason"] = r.failure->reason, json["message"] = r.failure->message;
  if (r.statistics) json["statistics"] = to_json(*r.statistics);  // where it stands already, or else at the end
  return json;
}

MeasurementResult measurement_from(const Json& json) {
  using Kind = MeasurementResult::Kind;
  MeasurementResult r;
  r.failure = failure_from(json);
  take(json, "model", r.model, model_from);
  const Json decisions = member(json, "decisions");
  for (const auto& [key, value] : decisions.items()) r.decisions.emplace_back(key, value);
  take(json, "time_reached", r.time_reached, number_or_nan);
  take(json, "factor_bytes", r.factor_bytes, [](const Json& x) { return x.get<std::size_t>(); });
  if (json.contains("wall"))
    r.timing = Timing{json.at("repeats"), spread_from(json.at("wall")), spread_from(json.at("cpu")),
                      number_or_nan(json.at("peak_memory_bytes"))};
  take(json, "statistics", r.statistics, statistics_from);
  take(json, "kind", r.kind, [](const Json& word) { return word == "exact" ? Kind::exact : Kind::computed; });
  take(json, "own_errors", r.own_errors, errors_from);
  take(json, "mesh_error", r.mesh_error, number_or_nan);
  take(json, "seconds", r.seconds, number_or_nan);
  take(json, "drift", r.drift, drift_from);
  take(json, "drift_over_time", r.drift_over_time, energy_change_from);
  take(json, "smallest_det_f", r.smallest_det_f, number_or_nan);
  take(json, "scales", r.scales, scales_from);
  take(json, "errors", r.errors, errors_from);
  r.at = json.value("at", "");
  return r;
}

}  // namespace orthodyn::study::compare
