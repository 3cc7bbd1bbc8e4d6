// Runs the jobs of a study, several at a time. Results are kept on disk, in folders named by the fingerprint of the
// job's input, and are not computed again. Jobs that depend on the results of others go into a later call of run().
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "lib/study/jobs/job_result.h"

namespace orthodyn::study {

// Functions called with the index of a job. `cached`: the result was on disk, or comes from an earlier job with the
// same folder; such jobs do not start.
struct JobEvents {
  std::function<void(std::size_t)> starts = [](std::size_t) {};
  std::function<void(std::size_t, const Json& result, bool cached)> ends;
};

class JobQueue {
 public:
  struct Options {
    std::vector<std::string> program;  // started as `PROGRAM... COMMAND FOLDER`
    int workers = 1;                   // concurrent jobs
    OldFailures failures = OldFailures::keep;
    // Called for each damaged result of an earlier run; its job is repeated.
    std::function<void(const std::string& text)> warn = [](const std::string&) {};
  };

  // `interrupt` kills the jobs in progress, which then have no result. It must outlive the queue.
  JobQueue(Options options, const std::atomic<bool>& interrupt) : options_(std::move(options)), interrupt_(interrupt) {}

  // Starts the jobs in order and waits for all of them. Jobs with the same folder are run once. Events come one at a
  // time but in any order. Returns false if interrupted. If an event or run_job() throws, stops the jobs in progress
  // and rethrows the exception.
  bool run(const std::vector<Job>& jobs, const JobEvents& events) const;

 private:
  Options options_;
  const std::atomic<bool>& interrupt_;
};

}  // namespace orthodyn::study
