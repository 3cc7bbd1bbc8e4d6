// The jobs of a study, several at a time. What is finished is on disk, in a folder whose name is the fingerprint of the
// job's input, and is not done again. Jobs that need the results of others are a further stage: another call of run().
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "lib/study/jobs/job_result.h"

namespace orthodyn::study {

// What those who wait for jobs see, by the job's index.
struct JobEvents {
  std::function<void(std::size_t)> starts = [](std::size_t) {};
  std::function<void(std::size_t, const Json& result, bool cached)> ends;  // cached: it was done before
};

class JobQueue {
 public:
  struct Options {
    std::vector<std::string> program;  // started as `PROGRAM... COMMAND FOLDER`
    int workers = 1;                   // processes at a time
    OldFailures failures = OldFailures::keep;
    // Told of what an earlier run has left and is damaged, which is done again.
    std::function<void(const std::string& text)> warn = [](const std::string&) {};
  };

  // `interrupt` ends the jobs in progress, without a result; it must outlive the queue.
  JobQueue(Options options, const std::atomic<bool>& interrupt) : options_(std::move(options)), interrupt_(interrupt) {}

  // Runs a stage: the jobs begin in their order, and all that begin have ended when it returns. Jobs that share a
  // folder are one piece of work, done once. Events come one after the other, in no order. False if interrupted. Throws
  // what an event or run_job() throws; the jobs in progress are given up then.
  bool run(const std::vector<Job>& jobs, const JobEvents& events) const;

 private:
  Options options_;
  const std::atomic<bool>& interrupt_;
};

}  // namespace orthodyn::study
