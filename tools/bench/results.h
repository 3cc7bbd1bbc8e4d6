// Benchmark results: collecting, printing, comparing, JSON.
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
  double nanoseconds = 0;                        // per element: minimum of all repetitions
  double elements = 0, unknowns = 0, bytes = 0;  // 0: not applicable; bytes of the factor
};

// Collects the minimum time of each benchmark and prints its name on standard error.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override;
  const std::vector<Result>& results() const { return results_; }

 private:
  std::vector<Result> results_;
};

// Results of an earlier measurement and its machine.
struct Baseline {
  Json context;
  std::map<std::string, double> nanoseconds;  // per element, by name
};

Json to_json(const std::vector<Result>& results);

// Throws ConfigError if the file is not from to_json(), or from a version that measured processor time.
Baseline read_baseline(const std::filesystem::path& file);

// Prints machine, versions and a line per result. With a baseline, also prints ratios and marks results that are more
// than 10 % slower. Returns the number of marked results.
int print(const std::vector<Result>& results, const std::optional<Baseline>& baseline);

}  // namespace orthodyn::bench
