// What the study commands print while they run and when they end.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "lib/study/jobs/job_result.h"

namespace orthodyn {

// Prints a line for each finished job, with the estimated time left.
class ProgressReporter {
 public:
  explicit ProgressReporter(bool quiet) : quiet_(quiet) {}

  // `count`: number of all jobs, which may change between calls. `cached`: the job was done by an earlier command; its
  // time does not enter the estimate.
  void report(std::size_t count, const std::string& title, const std::string& outcome, bool cached);

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_;
  Clock::time_point began_ = Clock::now();
  std::size_t number_ = 0, worked_ = 0;  // reported jobs; those of them that were not cached
};

// Counts the failed points of a study.
class FailureSummary {
 public:
  // Adds a computed point. `failure`: empty if the point succeeded.
  void add(const std::string& title, const std::optional<study::Failure>& failure);

  // Prints the number of failures and the first failure's message to stderr; nothing without failures.
  void print() const;

  // 3 if all points failed, else 0, because single failures are results of the study.
  int exit_code() const { return failed_ > 0 && failed_ == count_ ? 3 : 0; }

 private:
  std::size_t count_ = 0, failed_ = 0;
  std::string first_;
};

// Says that `count` earlier failures at a limit of time or memory were kept, and that --retry repeats them.
void print_kept_failures(std::size_t count);

// Prints that the study was interrupted and how to continue it. `pieces`: plural of its unit of work, such as "points".
void print_interrupted(const char* pieces, const std::filesystem::path& folder);

}  // namespace orthodyn
