// What came out of one field of a matrix of hard cases: the border, as JSON, between the process that fills the matrix
// and the one that runs the case.
#pragma once

#include <optional>
#include <string>

#include "lib/ode/statistics.h"
#include "lib/study/jobs/job_result.h"

namespace orthodyn::study::stability {

// What is to be done.
struct CaseInput {
  double seconds = 60;  // limit of the integration
  std::string code;     // fingerprint of the program that is to do it
};

Json to_json(const CaseInput& input);
CaseInput case_input_from(const Json& json);

// The metric that is farthest from what was expected.
struct WorstMetric {
  std::string title, unit;
  double computed = 0;  // NaN where the run has no such metric
  double expected = 0, limit = 0;
  std::string source, tolerance;  // where the value is known from, why the tolerance is what it is
};

// Of a run that came far enough to be graded.
struct GradedRun {
  bool completed = false;
  std::string grade;   // "pass", "degraded", "fail"
  std::string reason;  // of what is no pass
  std::optional<WorstMetric> worst;
  double time_reached = 0, wall_seconds = 0, cpu_seconds = 0;  // s
  std::optional<Statistics> statistics;                        // none in statics
};

Json to_json(const GradedRun& run);

struct StabilityResult {
  std::optional<GradedRun> run;
  Failure failure;  // of what could not be graded: refused by the integrator, killed, crashed
  std::string at;   // when: 2026-01-31T12:00:00Z; "" if the process died

  std::string grade() const;   // "refused", too
  std::string reason() const;  // in a few words
};

Json to_json(const StabilityResult& result);
StabilityResult stability_result_from(const Json& json);

}  // namespace orthodyn::study::stability
