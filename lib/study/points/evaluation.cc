#include "lib/study/points/evaluation.h"

#include <fmt/format.h>

#include "lib/core/digits.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study {

namespace {

Json metric_json(const WantedMetric& f) {
  return {{"quantity", f.quantity},
          {"take", Value<Take>::yaml(f.take)},
          {"at", optional_json(f.at)},
          {"of", optional_json(f.of)},
          {"settled_within", optional_json(f.settled_within)},
          {"mode", optional_json(f.mode)},
          {"along", f.along ? Json(Value<Component>::yaml(*f.along)) : Json()},
          {"about_equilibrium", f.about_equilibrium},
          {"cost", f.cost}};
}

WantedMetric metric_from(const Json& json) {
  WantedMetric f;
  f.quantity = json.at("quantity");
  f.take = from_word<Take>(json.at("take"));
  f.at = optional_from<double>(json.at("at"));
  f.of = optional_from<double>(json.at("of"));
  f.settled_within = optional_from<double>(json.at("settled_within"));
  f.mode = optional_from<int>(json.at("mode"));
  if (!json.at("along").is_null()) f.along = from_word<Component>(json.at("along"));
  f.about_equilibrium = json.at("about_equilibrium");
  f.cost = json.at("cost");
  f.origin.where = "quantities";
  return f;
}

EvaluationCost cost_from(const Json& json) {
  EvaluationCost cost{json.at("cpu_seconds"), json.at("wall_seconds"), {}, number_or_nan(json.at("peak_memory"))};
  if (!json.contains("steps")) return cost;
  Statistics& s = cost.statistics.emplace();
  s.steps = json.at("steps");
  s.rejected_steps = json.at("rejected_steps");
  s.newton_iterations = json.at("newton_iterations");
  s.force.count = json.at("forces");
  s.tangent.count = json.at("tangents");
  s.factorization.count = json.at("factorizations");
  s.solve.count = json.at("solves");
  return cost;
}

}  // namespace

Json to_json(const EvaluationInput& input) {
  Json metrics = Json::object();
  for (const auto& [name, f] : input.metrics) metrics[name] = metric_json(f);
  Json json{{"metrics", metrics},
            {"frame", optional_json(input.frame)},
            {"frame_at", optional_json(input.frame_at)},
            {"seconds", input.seconds},
            {"code", input.code}};
  if (input.mesh_error) json["mesh_error"] = true;
  return json;
}

EvaluationInput evaluation_input_from(const Json& json) {
  EvaluationInput input;
  for (const auto& [name, f] : json.at("metrics").items()) input.metrics.emplace_back(name, metric_from(f));
  input.frame = optional_from<std::string>(json.at("frame"));
  input.frame_at = optional_from<double>(json.at("frame_at"));
  input.seconds = json.at("seconds");
  input.code = json.at("code");
  input.mesh_error = json.value("mesh_error", false);
  return input;
}

// The keys are those of cost_names().
Json to_json(const EvaluationCost& cost) {
  Json json{{"cpu_seconds", cost.cpu_seconds}, {"wall_seconds", cost.wall_seconds}};
  if (cost.statistics) {
    const Statistics& s = *cost.statistics;
    json["steps"] = s.steps;
    json["rejected_steps"] = s.rejected_steps;
    json["newton_iterations"] = s.newton_iterations;
    json["forces"] = s.force.count;
    json["tangents"] = s.tangent.count;
    json["factorizations"] = s.factorization.count;
    json["solves"] = s.solve.count;
  }
  json["peak_memory"] = cost.peak_memory;
  return json;
}

std::string known_value(const EvaluationResult& result, const std::string& metric, double value) {
  for (const auto& [name, share] : result.metric_errors)
    if (name == metric) return known_digits(value, share);
  return fmt::format("{:.6g}", value);
}

Json to_json(const EvaluationResult& r) {
  Json json{{"status", r.failure ? "failed" : "completed"}, {"metrics", Json::object()}, {"units", Json::object()}};
  for (const auto& [name, value] : r.metrics) json["metrics"][name] = finite_or_null(value);
  for (const auto& [name, unit] : r.units) json["units"][name] = unit;
  json["cost"] = r.cost ? to_json(*r.cost) : Json();
  if (r.modes_cost) json["modes_cost"] = to_json(*r.modes_cost);
  if (r.unknowns) json["model"] = {{"unknowns", *r.unknowns}, {"elements", r.elements.value_or(0)}};
  if (r.failure) json["reason"] = r.failure->reason, json["message"] = r.failure->message;
  if (!r.frame.empty()) json["frame"] = r.frame;
  if (r.mesh_error) json["mesh_error"] = *r.mesh_error;
  for (const auto& [name, error] : r.metric_errors) json["metric_errors"][name] = finite_or_null(error);
  if (!r.kinematics.empty()) json["kinematics"] = r.kinematics;
  if (!r.warnings.empty()) json["warnings"] = r.warnings;
  return json;
}

EvaluationResult evaluation_from(const Json& json) {
  EvaluationResult r;
  r.failure = failure_from(json);
  const Json metrics = member(json, "metrics"), units = member(json, "units"), cost = member(json, "cost"),
             modes_cost = member(json, "modes_cost"), model = member(json, "model");
  for (const auto& [name, value] : metrics.items()) r.metrics.emplace_back(name, number_or_nan(value));
  for (const auto& [name, unit] : units.items()) r.units.emplace_back(name, unit);
  if (cost.is_object()) r.cost = cost_from(cost);
  if (modes_cost.is_object()) r.modes_cost = cost_from(modes_cost);
  if (model.is_object()) r.unknowns = model.at("unknowns"), r.elements = model.at("elements");
  r.frame = json.value("frame", "");
  r.kinematics = json.value("kinematics", "");
  r.warnings = json.value("warnings", std::vector<std::string>());
  if (json.contains("mesh_error")) r.mesh_error = json.at("mesh_error").get<double>();
  const Json errors = member(json, "metric_errors");
  for (const auto& [name, error] : errors.items()) r.metric_errors.emplace_back(name, number_or_nan(error));
  return r;
}

}  // namespace orthodyn::study
