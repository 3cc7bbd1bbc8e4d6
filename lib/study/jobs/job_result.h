// The common part of all job results, and the decision which earlier results are final. A failed result is
// {"status": "failed", "reason", "message"}.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/run/outcome.h"
#include "lib/study/jobs/job.h"

namespace orthodyn::study {

// Reasons of failures in addition to those of a run (lib/core/errors.h).
inline constexpr const char* kTimeLimit = "time limit";
inline constexpr const char* kCrashed = "crashed";  // the process died
inline constexpr const char* kRefused = "refused";  // the scene cannot be run: ConfigError

struct Failure {
  std::string reason;  // one or two words for tables: "time limit"
  std::string message;
};

Json to_json(const Failure& failure);
// {"status": "completed"}, or the failure.
Json status_json(const std::optional<Failure>& failure);
// Empty if the result was completed.
std::optional<Failure> failure_from(const Json& result);

// Failure of a run that did not complete. `seconds`: the run's wall time limit.
Failure failure_of(const Outcome& outcome, double seconds);

// Treatment of failures of an earlier run.
enum class OldFailures { keep, retry };

// A result file contains its own fingerprint, so that a damaged or truncated file is noticed.
Json with_fingerprint(Json result);
void write_result(const std::filesystem::path& folder, const Json& result);
Json read_result(const std::filesystem::path& folder);  // null if missing or damaged

// The result of an earlier run, or null if the job must run. It must run if no result is complete, if the process
// crashed or the disk was full (the cause may be gone), and after any failure with OldFailures::retry.
Json finished_result(const Job& job, OldFailures failures = OldFailures::keep);

// The damaged result file of an earlier run, or the job's folder if another file of the result is damaged; empty if
// nothing is damaged.
std::optional<std::filesystem::path> damaged_file(const Job& job);

// True for a failure at the limit of time or memory.
bool met_a_limit(const std::optional<Failure>& failure);

// Number of earlier results that failed at a limit; each folder counts once.
std::size_t number_at_limits(const std::vector<Job>& jobs);

}  // namespace orthodyn::study
