// A matrix of hard cases: runs each of its fields in a process of its own, and tells what came out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lib/study/jobs/job_queue.h"
#include "lib/study/stability/stability.h"
#include "lib/study/stability/stability_result.h"

namespace orthodyn::study::stability {

class StabilityMatrix {
 public:
  // What is finished in the folder is not done again. Throws ConfigError for input that is at fault.
  StabilityMatrix(Stability stability, std::filesystem::path folder);

  // Calls `after_each` for each run that is over, or was done before. False if interrupted. Throws as JobQueue::run().
  bool run(const JobQueue& queue,
           const std::function<void(std::size_t run, const StabilityResult&, bool cached)>& after_each);

  const std::vector<StabilityRun>& runs() const { return runs_; }
  const std::vector<Job>& jobs() const { return jobs_; }  // by run

  // The document of the report, and a row a run; of what is done. `file`: the study's.
  Json json(const std::string& file) const;
  std::string csv() const;

 private:
  Json run_json(std::size_t run, const StabilityResult& result) const;

  Stability stability_;
  std::filesystem::path folder_;
  std::vector<std::string> sentences_;  // of the cases
  std::vector<StabilityRun> runs_;
  std::vector<Job> jobs_;
  std::map<std::size_t, StabilityResult> results_;
};

}  // namespace orthodyn::study::stability
