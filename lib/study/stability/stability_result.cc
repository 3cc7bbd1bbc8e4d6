#include "lib/study/stability/stability_result.h"

#include "lib/study/jobs/json_fields.h"

namespace orthodyn::study {

template <>
const JsonFields<stability::CaseInput> json_fields<stability::CaseInput>{{"seconds", &stability::CaseInput::seconds},
                                                                         {"code", &stability::CaseInput::code}};

template <>
const JsonFields<stability::WorstMetric> json_fields<stability::WorstMetric>{
    {"title", &stability::WorstMetric::title},        {"unit", &stability::WorstMetric::unit},
    {"computed", &stability::WorstMetric::computed},  {"expected", &stability::WorstMetric::expected},
    {"limit", &stability::WorstMetric::limit},        {"source", &stability::WorstMetric::source},
    {"tolerance", &stability::WorstMetric::tolerance}};

template <>
const JsonFields<stability::GradedRun> json_fields<stability::GradedRun>{
    {"grade", &stability::GradedRun::grade},
    {"reason", &stability::GradedRun::reason},
    {"worst", &stability::GradedRun::worst, Empty::null},
    {"time_reached", &stability::GradedRun::time_reached},
    {"wall", &stability::GradedRun::wall_seconds},
    {"cpu", &stability::GradedRun::cpu_seconds},
    {"statistics", &stability::GradedRun::statistics}};

namespace stability {

Json to_json(const CaseInput& input) { return JsonValue<CaseInput>::to(input); }
CaseInput case_input_from(const Json& json) { return JsonValue<CaseInput>::from(json); }

Json to_json(const GradedRun& run) {
  Json json{{"status", run.completed ? "completed" : "failed"}};
  json_fields<GradedRun>.write(run, json);
  return json;
}

std::string StabilityResult::grade() const {
  if (run) return run->grade;
  return failure.reason == kRefused ? "refused" : "fail";
}

std::string StabilityResult::reason() const {
  if (run) return run->reason;
  return failure.reason == kTimeLimit ? failure.reason : failure.message;
}

Json to_json(const StabilityResult& result) {
  Json json = result.run ? to_json(*result.run) : to_json(Failure{result.reason(), result.failure.message});
  if (!result.at.empty()) json["at"] = result.at;
  if (!result.run) json["grade"] = result.grade();
  return json;
}

StabilityResult stability_result_from(const Json& json) {
  StabilityResult result;
  result.at = json.value("at", "");
  if (json.contains("grade")) {
    result.run = JsonValue<GradedRun>::from(json);
    result.run->completed = json.at("status") == "completed";
  } else {
    result.failure = failure_from(json).value_or(Failure{});
  }
  return result;
}

}  // namespace stability

}  // namespace orthodyn::study
