// Runs a stability study and formats its results. Each run (case x variant x integrator) has its own process.
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
  // Reads and builds every scene. Results already in the folder are kept. Throws ConfigError for invalid input.
  StabilityMatrix(Stability stability, std::filesystem::path folder);

  // Calls `after_each` for each run, also if its result was not computed now (`cached`, see JobEvents). Returns false
  // if interrupted. Throws as JobQueue::run() does.
  bool run(const JobQueue& queue,
           const std::function<void(std::size_t run, const StabilityResult&, bool cached)>& after_each);

  const std::vector<StabilityRun>& runs() const { return runs_; }
  const std::vector<Job>& jobs() const { return jobs_; }  // one per run

  // The finished runs as a JSON document, and as CSV with one row per run. `file`: path of the study's file.
  Json json(const std::string& file) const;
  std::string csv() const;

 private:
  Json run_json(std::size_t run, const StabilityResult& result) const;

  Stability stability_;
  std::filesystem::path folder_;
  std::vector<std::string> sentences_;  // descriptions of the cases
  std::vector<StabilityRun> runs_;
  std::vector<Job> jobs_;
  std::map<std::size_t, StabilityResult> results_;
};

// An expectation that all completed integrators miss by about the same amount. The fault is then suspected in the
// expectation or in the model, not in the integrators.
struct Suspicion {
  std::string hard_case, variant, metric;
  std::size_t integrators = 0;     // number that completed
  double lowest = 0, highest = 0;  // computed values
  double expected = 0;
};

// One sentence for the report.
std::string describe(const Suspicion& suspicion);

// `cases` and `trials`: as in stability.json. An expectation of a case and variant is suspected if at least two
// integrators completed, none of them passes, all have the same worst metric, and the computed values of this metric
// differ by at most its limit. Cases whose `model` is not empty (HardCase) are left out.
std::vector<Suspicion> suspected_expectations(const Json& cases, const Json& trials);

}  // namespace orthodyn::study::stability
