// What all results of jobs have in common: whether the work was completed, and if not why; and which results are final.
// A failure is {"status": "failed", "reason", "message"}, everything else is the work's own.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/run/outcome.h"
#include "lib/study/jobs/job.h"

namespace orthodyn::study {

// The reasons of failures that are no run's own. Of a run or a process that took too long:
inline constexpr const char* kTimeLimit = "time limit";
// Of a process that died for no reason of ours.
inline constexpr const char* kCrashed = "crashed";
// Of a scene that cannot be run as it is.
inline constexpr const char* kRefused = "refused";

struct Failure {
  std::string reason;   // in a word or two, for tables: "time limit"
  std::string message;  // what, where, what to try
};

Json to_json(const Failure& failure);
// Nothing for a result that was completed.
std::optional<Failure> failure_from(const Json& result);

// Of a run that did not come to its end; `seconds`: the wall time that it might take.
Failure failure_of(const Outcome& outcome, double seconds);

// What to do about the failures of an earlier run.
enum class OldFailures { keep, retry };

// A result as it is kept in a job's folder, with a fingerprint of itself: what was damaged or cut short since is none.
Json with_fingerprint(Json result);
void write_result(const std::filesystem::path& folder, const Json& result);
Json read_result(const std::filesystem::path& folder);  // null if there is none

// The result of an earlier run that need not be done again; null if there is none, if it is not whole, or if it is to
// be tried again: always after a crash or a full disk, whose cause may be gone by now, and every failure if `failures`
// says so.
Json finished_result(const Job& job, OldFailures failures = OldFailures::keep);

// What an earlier run has left of a job and has changed since: its result, or its folder for the files that belong to
// it.
std::optional<std::filesystem::path> damaged_file(const Job& job);

// A failure at the limit of time or memory: with more of either, or on another machine, it may get through.
bool met_a_limit(const std::optional<Failure>& failure);

// How many of the jobs that an earlier run did met a limit, each folder counted once.
std::size_t number_at_limits(const std::vector<Job>& jobs);

}  // namespace orthodyn::study
