#include "lib/study/points/evaluation.h"

#include <fmt/format.h>

#include "lib/core/number_format.h"
#include "lib/study/jobs/json_fields.h"

namespace orthodyn::study {

template <>
const JsonFields<WantedMetric> json_fields<WantedMetric>{{"quantity", &WantedMetric::quantity},
                                                         {"take", &WantedMetric::take},
                                                         {"at", &WantedMetric::at, Empty::null},
                                                         {"of", &WantedMetric::of, Empty::null},
                                                         {"settled_within", &WantedMetric::settled_within, Empty::null},
                                                         {"response", &WantedMetric::response, Empty::null},
                                                         {"frequency", &WantedMetric::frequency, Empty::null},
                                                         {"mode", &WantedMetric::mode, Empty::null},
                                                         {"matching", &WantedMetric::matching},
                                                         {"along", &WantedMetric::along, Empty::null},
                                                         {"buckling", &WantedMetric::buckling, Empty::null},
                                                         {"about_equilibrium", &WantedMetric::about_equilibrium},
                                                         {"cost", &WantedMetric::cost}};

template <>
const JsonFields<ModeMatching> json_fields<ModeMatching>{{"frequencies", &ModeMatching::frequencies},
                                                         {"band", &ModeMatching::band},
                                                         {"points", &ModeMatching::points},
                                                         {"direction", &ModeMatching::direction},
                                                         {"shapes", &ModeMatching::shapes}};

template <>
const JsonFields<ModeMatch> json_fields<ModeMatch>{{"mode", &ModeMatch::mode},
                                                   {"mac", &ModeMatch::mac},
                                                   {"next", &ModeMatch::next},
                                                   {"next_mac", &ModeMatch::next_mac},
                                                   {"failure", &ModeMatch::failure, Empty::omitted}};

template <>
const JsonFields<EvaluationInput> json_fields<EvaluationInput>{
    {"metrics", &EvaluationInput::metrics},
    {"frame", &EvaluationInput::frame, Empty::null},
    {"frame_at", &EvaluationInput::frame_at, Empty::null},
    {"seconds", &EvaluationInput::seconds},
    {"code", &EvaluationInput::code},
    {"mesh_error", &EvaluationInput::mesh_error, Empty::omitted},
    {"parameters", &EvaluationInput::parameters, Empty::omitted},
    {"matchings", &EvaluationInput::matchings, Empty::omitted}};

template <>
const JsonFields<EvaluationCost> json_fields<EvaluationCost> = [] {
  JsonFields<EvaluationCost> all{};
  for (const CostField& cost : cost_fields())
    std::visit([&](auto member) { all.add({cost.name, member}); }, cost.member);
  return all;
}();

template <>
const JsonFields<EvaluationModel> json_fields<EvaluationModel>{{"unknowns", &EvaluationModel::unknowns},
                                                               {"elements", &EvaluationModel::elements}};

template <>
const JsonFields<EvaluationResult> json_fields<EvaluationResult>{
    {"metrics", &EvaluationResult::metrics},
    {"units", &EvaluationResult::units},
    {"cost", &EvaluationResult::cost, Empty::null},
    {"modes_cost", &EvaluationResult::modes_cost},
    {"model", &EvaluationResult::model},
    {"frame", &EvaluationResult::frame, Empty::omitted},
    {"mesh_error", &EvaluationResult::mesh_error},
    {"metric_errors", &EvaluationResult::metric_errors, Empty::omitted},
    {"derivatives", &EvaluationResult::derivatives, Empty::omitted},
    {"matches", &EvaluationResult::matches, Empty::omitted},
    {"kinematics", &EvaluationResult::kinematics, Empty::omitted},
    {"warnings", &EvaluationResult::warnings, Empty::omitted}};

Json to_json(const EvaluationInput& input) { return JsonValue<EvaluationInput>::to(input); }

EvaluationInput evaluation_input_from(const Json& json) {
  EvaluationInput input = JsonValue<EvaluationInput>::from(json);
  for (auto& [name, metric] : input.metrics) metric.origin.where = "quantities";
  return input;
}

Json to_json(const EvaluationCost& cost) { return JsonValue<EvaluationCost>::to(cost); }

Json to_json(const EvaluationResult& result) {
  Json json = status_json(result.failure);
  json_fields<EvaluationResult>.write(result, json);
  return json;
}

EvaluationResult evaluation_from(const Json& json) {
  EvaluationResult result;
  result.failure = failure_from(json);
  if (result.failure) json_fields<EvaluationResult>.read_present(json, result);  // a crash leaves its reason alone
  else json_fields<EvaluationResult>.read(json, result);
  return result;
}

std::string known_value(const EvaluationResult& result, const std::string& metric, double value) {
  for (const auto& [name, error] : result.metric_errors)
    if (name == metric) return known_digits(value, error);
  return fmt::format("{:.6g}", value);
}

}  // namespace orthodyn::study
