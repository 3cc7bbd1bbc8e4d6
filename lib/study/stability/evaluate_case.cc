#include "lib/study/stability/evaluate_case.h"

#include "lib/simulation/output/frames.h"
#include "lib/study/jobs/deadline.h"
#include "lib/study/stability/case_grade.h"
#include "lib/study/stability/stability_result.h"

namespace orthodyn::study::stability {

namespace fs = std::filesystem;

namespace {

WorstMetric worst_metric(const Check& check) {
  return {check.expectation.title(),
          check.unit,
          check.computed,
          check.expectation.value,
          check.expectation.limit(),
          check.expectation.source,
          check.expectation.reason};
}

void write_end_state(const fs::path& file, const FemModel& model, const State& state) {
  if (!state.q.allFinite()) return;
  write_vtu(file, model.geometry(),
            {{"displacement", Location::node, 3, model.evaluate("displacement", state)},
             {"det_f", Location::cell, 1, model.evaluate("det_f", state)}});
}

GradedRun graded_run(const fs::path& folder, const Setup& setup, double seconds) {
  Deadline deadline(seconds);
  const CaseResult result = verify(setup, {&deadline}, deadline.over);
  const CaseGrade graded = grade(result);
  GradedRun run;
  run.completed = result.completed();
  run.grade = grade_word(graded.grade);
  run.reason = result.outcome.status == Outcome::Status::interrupted ? kTimeLimit : graded.reason;
  if (graded.worst) run.worst = worst_metric(*graded.worst);
  run.time_reached = result.outcome.last.t;
  run.wall_seconds = result.outcome.wall_seconds;
  run.cpu_seconds = result.outcome.cpu_seconds;
  if (setup.integrator) run.statistics = setup.integrator->statistics();
  write_end_state(folder / kEndState, *setup.built.model, result.outcome.last);
  return run;
}

// Its set-up may be refused, by the integrator most of all; what the input does wrong in mid-run is a failure.
GradedRun set_up_and_run(const fs::path& folder, double seconds) {
  const Setup setup = set_up(Config::from_file((folder / kSceneFile).string()));
  try {
    return graded_run(folder, setup, seconds);
  } catch (const ConfigError& e) {
    throw RunError(e.what());
  }
}

}  // namespace

void evaluate_case(const fs::path& folder) {
  serve_job(folder, [&](const Json& input) { return to_json(set_up_and_run(folder, case_input_from(input).seconds)); });
}

}  // namespace orthodyn::study::stability
