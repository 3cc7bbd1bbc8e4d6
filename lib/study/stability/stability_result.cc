#include "lib/study/stability/stability_result.h"

#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::stability {

namespace {

Json to_json(const WorstMetric& f) {
  return {{"title", f.title},        {"unit", f.unit},   {"computed", finite_or_null(f.computed)},
          {"expected", f.expected},  {"limit", f.limit}, {"source", f.source},
          {"tolerance", f.tolerance}};
}

WorstMetric worst_from(const Json& json) {
  return {json.at("title"),    json.at("unit"),  number_or_nan(json.at("computed")),
          json.at("expected"), json.at("limit"), json.at("source"),
          json.at("tolerance")};
}

GradedRun graded_run_from(const Json& json) {
  GradedRun run;
  run.completed = json.at("status") == "completed";
  run.grade = json.at("grade");
  run.reason = json.at("reason");
  if (!json.at("worst").is_null()) run.worst = worst_from(json.at("worst"));
  run.time_reached = json.at("time_reached");
  run.wall_seconds = json.at("wall");
  run.cpu_seconds = json.at("cpu");
  if (json.contains("statistics")) run.statistics = statistics_from(json.at("statistics"));
  return run;
}

}  // namespace

Json to_json(const CaseInput& input) { return {{"seconds", input.seconds}, {"code", input.code}}; }

CaseInput case_input_from(const Json& json) { return {json.at("seconds"), json.at("code")}; }

Json to_json(const GradedRun& run) {
  Json json{{"status", run.completed ? "completed" : "failed"},
            {"grade", run.grade},
            {"reason", run.reason},
            {"worst", run.worst ? to_json(*run.worst) : Json()},
            {"time_reached", run.time_reached},
            {"wall", run.wall_seconds},
            {"cpu", run.cpu_seconds}};
  if (run.statistics) json["statistics"] = to_json(*run.statistics);
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
  if (json.contains("grade")) result.run = graded_run_from(json);
  else result.failure = failure_from(json).value_or(Failure{});
  return result;
}

}  // namespace orthodyn::study::stability
