// One run of a stability study: its input and its result, exchanged as JSON between the process that collects the
// results (StabilityMatrix: cases by integrators) and the one that runs the case.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lib/ode/statistics.h"
#include "lib/study/jobs/job_result.h"
#include "lib/study/quantities/verify.h"

namespace orthodyn::study::stability {

struct CaseInput {
  double seconds = 60;  // wall time limit of the run, s
  std::string code;     // fingerprint of the program that must do the work
};

Json to_json(const CaseInput& input);
CaseInput case_input_from(const Json& json);

// The metric with the worst grade; of several such, the one with the largest deviation in multiples of its tolerance.
struct WorstMetric {
  std::string title, unit;
  double computed = 0;             // NaN if the run has no such metric
  double expected = 0, limit = 0;  // limit: tolerance of the expectation
  std::string source, tolerance;   // source of the expected value, reason of the tolerance
};

// A run that was graded: either completed, or stopped with the grade "fail".
struct GradedRun {
  bool completed = false;
  std::string grade;   // "pass", "degraded", "fail"
  std::string reason;  // "" for pass
  std::optional<WorstMetric> worst;
  double time_reached = 0, wall_seconds = 0, cpu_seconds = 0;  // s
  std::optional<Statistics> statistics;                        // empty for statics
};

Json to_json(const GradedRun& run);

struct StabilityResult {
  std::optional<GradedRun> run;
  Failure failure;  // without `run`: the set-up refused the scene, or the process failed or died
  std::string at;   // end of the run: 2026-01-31T12:00:00Z; "" if the process died

  std::string grade() const;   // "pass", "degraded", "fail" or "refused"
  std::string reason() const;  // in a few words
};

// For stability.json. Has the key `grade` even if the run was not graded, so stability_result_from() cannot read it
// back.
Json to_json(const StabilityResult& result);
// Reads the result of an "assess" job. Treats any result with the key `grade` as a graded run.
StabilityResult stability_result_from(const Json& json);

enum class Grade { pass, degraded, fail };

struct CaseGrade {
  Grade grade = Grade::fail;
  std::optional<Check> worst;  // as in WorstMetric; empty if the run did not complete
  std::string reason;          // in a few words; "" for pass
};

const char* grade_word(Grade grade);  // "pass"

// pass: all metrics are within their tolerances. degraded: all are within Expectation::degraded times their tolerances.
// fail: otherwise, or if the run did not complete. Precondition: a completed run has checks.
CaseGrade grade(const CaseResult& result);

// File with the last state of a run, in the run's folder.
inline constexpr const char* kEndState = "end.vtu";

// Does the job in `folder`: runs the scene, grades its metrics, and writes the last state unless its q is not finite.
// Throws as serve_job() does.
void evaluate_case(const std::filesystem::path& folder);

}  // namespace orthodyn::study::stability
