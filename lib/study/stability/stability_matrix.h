// Tries all fields of a matrix of hard cases, each in a process of its own, and tells what came out.
#pragma once

#include <functional>
#include <map>

#include "lib/study/jobs/errand.h"
#include "lib/study/stability/stability.h"

namespace orthodyn {

class StabilityMatrix {
 public:
  // What is finished in the folder is not done again. Throws ConfigError for input that is at fault.
  StabilityMatrix(Stability stability, std::filesystem::path folder, std::string program);

  // `jobs` at a time. False if it was interrupted. Throws as carry_out_all() does.
  bool run(int jobs, const std::atomic<bool>& interrupt, const ErrandEvents& events,
           OldFailures failures = OldFailures::keep);

  const std::vector<Trial>& trials() const { return trials_; }
  const std::vector<Errand>& errands() const { return errands_; }  // by trial
  std::size_t done() const { return results_.size(); }

  // The document of the report, and a row a trial; of what is done.
  Json json(const std::string& file) const;
  std::string csv() const;

 private:
  Json trial_json(std::size_t trial) const;

  Stability stability_;
  std::filesystem::path folder_;
  std::string program_;
  std::vector<std::string> sentences_;  // of the cases
  std::vector<Trial> trials_;
  std::vector<Errand> errands_;
  std::map<std::size_t, Json> results_;
};

}  // namespace orthodyn
