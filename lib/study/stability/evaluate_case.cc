// Runs and grades one hard case in its own process.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/simulation/output/frames.h"
#include "lib/study/jobs/deadline.h"
#include "lib/study/stability/stability_result.h"

namespace orthodyn::study::stability {

namespace fs = std::filesystem;

namespace {

// Difference in multiples of the tolerance; infinite for NaN.
double tolerances_off(const Check& check) {
  const double off = std::abs(check.difference()) / check.expectation.limit();
  return std::isnan(off) ? std::numeric_limits<double>::infinity() : off;
}

Grade grade_of(const Check& check) {
  if (check.passed()) return Grade::pass;
  return tolerances_off(check) <= check.expectation.degraded ? Grade::degraded : Grade::fail;
}

bool is_better(const Check& a, const Check& b) {
  return std::pair(grade_of(a), tolerances_off(a)) < std::pair(grade_of(b), tolerances_off(b));
}

std::string describe(const Check& check) {
  if (check.expectation.take == TimeReduction::onset && std::isnan(check.computed))
    return fmt::format("{} did not occur, expected {:.3g} +- {:.2g}", check.expectation.title(),
                       check.expectation.value.si(), check.expectation.limit());
  return fmt::format("{} is {:.3g}, expected {:.3g} +- {:.2g}", check.expectation.title(), check.computed,
                     check.expectation.value.si(), check.expectation.limit());
}

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

// A ConfigError of the set-up is a refusal; one during the run counts as a failure.
GradedRun set_up_and_run(const fs::path& folder, double seconds) {
  const Setup setup = set_up(Config::from_file((folder / kSceneFile).string()));
  try {
    return graded_run(folder, setup, seconds);
  } catch (const ConfigError& e) {
    throw RunError(e.what());
  }
}

}  // namespace

const char* grade_word(Grade grade) {
  switch (grade) {
    case Grade::pass: return "pass";
    case Grade::degraded: return "degraded";
    case Grade::fail: break;
  }
  return "fail";
}

CaseGrade grade(const CaseResult& result) {
  if (!result.completed()) return {Grade::fail, {}, result.outcome.message};
  const auto worst = std::max_element(result.checks.begin(), result.checks.end(), is_better);
  const Grade found = grade_of(*worst);
  return {found, *worst, found == Grade::pass ? "" : describe(*worst)};
}

void evaluate_case(const fs::path& folder) {
  serve_job(folder, [&](const Json& input) { return to_json(set_up_and_run(folder, case_input_from(input).seconds)); });
}

}  // namespace orthodyn::study::stability
