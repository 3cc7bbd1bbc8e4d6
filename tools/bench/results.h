// Measured times, as a table, as JSON, and against earlier ones.
#pragma once

#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/output/json.h"

namespace orthodyn::bench {

struct Result {
  std::string name;
  double nanoseconds = 0;                        // an element: the least of all repetitions
  double elements = 0, unknowns = 0, bytes = 0;  // 0 where there are none; bytes of a factor
};

// Collects the least time of each benchmark's repetitions, and tells on standard error what is being measured.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override;
  const std::vector<Result>& results() const { return results_; }

 private:
  std::vector<Result> results_;
};

// Results of an earlier run, and where it ran.
struct Before {
  Json context;
  std::map<std::string, double> nanoseconds;  // an element, by name
};

Json to_json(const std::vector<Result>& results);

// Throws ConfigError if the file is none of to_json(), or of a version that measured processor time.
Before read_before(const std::filesystem::path& file);

// Prints machine, versions and a line for each result; with `before` the ratios, a mark where more than 10 % were lost,
// and what cannot be compared. How many lines have a mark.
int print(const std::vector<Result>& results, const std::optional<Before>& before);

}  // namespace orthodyn::bench
