#include "lib/study/stability/assess.h"

#include "lib/simulation/frames.h"
#include "lib/study/jobs/deadline.h"
#include "lib/study/compare/measure.h"
#include "lib/study/quantities/verdict.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

Json to_json(const Check& check) {
  return {{"title", check.expectation.title()},
          {"unit", check.unit},
          {"computed", finite_or_null(check.computed)},
          {"expected", check.expectation.value},
          {"limit", check.expectation.limit()},
          {"source", check.expectation.source},
          {"tolerance", check.expectation.reason}};
}

std::string reason_of(const CaseResult& result, const Verdict& verdict) {
  if (result.outcome.status == Outcome::Status::interrupted) return kTimeLimit;
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

// Its set-up may be refused, by the integrator most of all; what the input does wrong in mid-run is a failure.
Json assessed(const fs::path& folder, double seconds) {
  const Setup setup = set_up(Config::from_file((folder / kSceneFile).string()));
  try {
    return judged(folder, setup, seconds);
  } catch (const ConfigError& e) {
    throw RunError(e.what());
  }
}

}  // namespace

void assess(const fs::path& folder) {
  do_job(folder, [&](const Json& job) { return assessed(folder, job.at("seconds")); });
}

}  // namespace orthodyn
