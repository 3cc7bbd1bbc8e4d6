#include "lib/study/jobs/job_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lib/core/errors.h"
#include "lib/core/fingerprint.h"
#include "lib/simulation/output/files.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study {

namespace {

constexpr const char* kFingerprintKey = "fingerprint";

bool is(const std::optional<Failure>& failure, const char* reason) { return failure && failure->reason == reason; }

// True if a repetition may succeed.
bool is_transient(const std::optional<Failure>& failure) {
  return is(failure, kCrashed) || is(failure, reason_name(Reason::disk));
}

}  // namespace

Json to_json(const Failure& failure) {
  return {{"status", "failed"}, {"reason", failure.reason}, {"message", failure.message}};
}

Json status_json(const std::optional<Failure>& failure) {
  return failure ? to_json(*failure) : Json{{"status", "completed"}};
}

std::optional<Failure> failure_from(const Json& result) {
  if (member(result, "status") != "failed") return std::nullopt;
  return Failure{result.value("reason", ""), result.value("message", "")};
}

Failure failure_of(const Outcome& outcome, double seconds) {
  if (outcome.status != Outcome::Status::interrupted) return {reason_name(outcome.reason), outcome.message};
  return {kTimeLimit,
          fmt::format(
              "reached t = {:.4g} s within the wall time limit of {:g} s; raise limits.seconds, or reduce the problem",
              outcome.last.t, seconds)};
}

Json with_fingerprint(Json result) {
  result[kFingerprintKey] = Fingerprint().add(to_text(result)).text();
  return result;
}

void write_result(const std::filesystem::path& folder, const Json& result) {
  write_file(folder / kResultFile, {to_text(with_fingerprint(result))});
}

Json read_result(const std::filesystem::path& folder) {
  Json result = read_json(folder / kResultFile);
  const Json fingerprint = member(result, kFingerprintKey);
  if (!fingerprint.is_string()) return nullptr;
  result.erase(kFingerprintKey);
  return fingerprint == Fingerprint().add(to_text(result)).text() ? result : Json(nullptr);
}

Json finished_result(const Job& job, OldFailures failures) {
  Json result = read_result(job.folder);
  if (result.is_null()) return nullptr;
  const auto failure = failure_from(result);
  if (is_transient(failure) || (failure && failures == OldFailures::retry)) return nullptr;
  if (job.is_whole && !job.is_whole(result)) return nullptr;
  return result;
}

std::optional<std::filesystem::path> damaged_file(const Job& job) {
  const Json result = read_result(job.folder);
  if (std::error_code ec; result.is_null() && std::filesystem::exists(job.folder / kResultFile, ec))
    return job.folder / kResultFile;
  if (!result.is_null() && job.is_whole && !job.is_whole(result)) return job.folder;
  return std::nullopt;
}

bool met_a_limit(const std::optional<Failure>& failure) {
  return is(failure, kTimeLimit) || is(failure, reason_name(Reason::out_of_memory));
}

std::size_t number_at_limits(const std::vector<Job>& jobs) {
  std::set<std::filesystem::path> folders;
  for (const auto& job : jobs) folders.insert(job.folder);
  return static_cast<std::size_t>(std::count_if(folders.begin(), folders.end(), [](const auto& folder) {
    return met_a_limit(failure_from(read_result(folder)));
  }));
}

}  // namespace orthodyn::study
