// The request for a run, and the common arguments of the dynamic, static, buckling and harmonic analyses.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/checkpoint/checkpoint.h"
#include "lib/simulation/output/result_folder.h"
#include "lib/simulation/run/run_listener.h"
#include "lib/simulation/run/run_result.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

struct RunRequest {
  std::filesystem::path folder;     // results
  bool force = false;               // replace an earlier result in the folder
  bool resume = false;              // resume from the checkpoint in the folder; start if there is no result yet
  bool estimate_error = false;      // repeat the completed run more accurately, and compare
  bool allow_large_output = false;  // permit a million frames or more (output_size.h)
  const Ranks* ranks = nullptr;     // ranks that compute the scene together; null: this process alone
};

struct RunContext {
  const std::string& scene;             // file name as given by the user
  const std::vector<std::string>& set;  // assignments to the scene, PATH=VALUE
  const RunRequest& request;
  const Setup& setup;
  const std::string& resolved;  // scene with all defaults, as YAML
  ResultFolder& folder;
  std::optional<Checkpoint> earlier;  // checkpoint to resume from; empty for a new run
  const std::atomic<bool>& interrupt;
  RunListener& listener;
};

// Runs the analysis, writes its results into the folder and returns them. Throws ConfigError before anything is
// written, RunError if a file cannot be written. A failed computation is a result, not an exception.
using RunAnalysis = RunResult (*)(RunContext context);

RunResult run_dynamic_analysis(RunContext context);
RunResult run_static_analysis(RunContext context);
RunResult run_buckling_analysis(RunContext context);
RunResult run_harmonic_analysis(RunContext context);

}  // namespace orthodyn
