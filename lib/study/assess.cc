#include "lib/study/assess.h"

#include <cmath>
#include <fstream>

#include "lib/run/vtu.h"
#include "lib/study/deadline.h"
#include "lib/study/fingerprint.h"
#include "lib/study/machine.h"
#include "lib/study/measure.h"
#include "lib/study/verdict.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// What infinite and undefined figures become: JSON has no word for them.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json to_json(const Check& check) {
  return {{"title", check.expectation.title()},
          {"computed", number(check.computed)},
          {"expected", check.expectation.value},
          {"limit", check.expectation.limit()},
          {"source", check.expectation.source},
          {"tolerance", check.expectation.reason}};
}

std::string reason_of(const CaseResult& result, const Verdict& verdict) {
  if (result.outcome.status == Outcome::Status::interrupted) return "time limit";
  return verdict.reason;
}

void write_end_state(const fs::path& file, const FemModel& model, const State& state) {
  if (!state.q.allFinite()) return;
  write_vtu(file, model.geometry(),
            {{"displacement", Location::node, 3, model.evaluate("displacement", state)},
             {"det_f", Location::cell, 1, model.evaluate("det_f", state)}});
}

Json judged(const fs::path& folder, const Setup& setup, double seconds) {
  Deadline deadline(seconds);
  const CaseResult result = verify(setup, {&deadline}, deadline.over);
  const Verdict verdict = judge(result);
  Json json{{"status", result.completed() ? "completed" : "failed"},
            {"grade", grade_word(verdict.grade)},
            {"reason", reason_of(result, verdict)},
            {"worst", verdict.worst ? to_json(*verdict.worst) : Json(nullptr)},
            {"time_reached", result.outcome.last.t},
            {"wall", result.outcome.wall_seconds},
            {"cpu", result.outcome.cpu_seconds}};
  if (setup.integrator) json["statistics"] = to_json(setup.integrator->statistics());
  write_end_state(folder / kEndState, *setup.built.model, result.outcome.last);
  return json;
}

Json result_of(const fs::path& folder) {
  std::ifstream in(folder / kJobFile);
  const Json job = Json::parse(in);
  if (job.at("code") != code_fingerprint())
    throw RunError("the program has changed since the matrix was started; start it again");
  try {
    return judged(folder, set_up(Config::from_file((folder / kSceneFile).string())), job.at("seconds"));
  } catch (const ConfigError& e) {
    return {{"status", "refused"}, {"grade", "refused"}, {"reason", e.what()}};
  }
}

}  // namespace

void assess(const fs::path& folder) {
  Json result = result_of(folder);
  result["at"] = utc_now();
  write_file(folder / kResultFile, {to_text(result)});
}

}  // namespace orthodyn
