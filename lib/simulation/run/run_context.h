// What the analyses of a scene are given, so that all are one kind of function.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/checkpoint/checkpoint.h"
#include "lib/simulation/output/result_folder.h"
#include "lib/simulation/run/run_listener.h"
#include "lib/simulation/run/run_result.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

// How a scene is to be run.
struct RunRequest {
  std::filesystem::path folder;  // for the results
  bool force = false;            // replace an earlier result in the folder
  bool resume = false;           // go on from the checkpoint in the folder, or begin if there is no result yet
  bool estimate_error = false;   // then repeat the run more accurately, and compare
  bool any_output_size = false;  // also a million frames and more (volume.h)
  const Ranks* ranks = nullptr;  // those that compute it together, all of which ask for it; null: this process alone
};

struct RunContext {
  const std::string& scene;             // its file, as it was named
  const std::vector<std::string>& set;  // what was changed in it
  const RunRequest& request;
  const Setup& setup;
  const std::string& resolved;  // the scene with every default, as YAML
  ResultFolder& folder;
  std::optional<Checkpoint> earlier;  // to go on from
  const std::atomic<bool>& interrupt;
  RunListener& listener;
};

// Computes the scene that is set up, writes its results into the folder, and returns what came of it. Throws
// ConfigError before anything is written, and RunError for files that cannot be written; a computation that could not
// go on is a result.
using RunAnalysis = RunResult (*)(RunContext context);

RunResult run_dynamic_analysis(RunContext context);
RunResult run_static_analysis(RunContext context);
RunResult run_buckling_analysis(RunContext context);

}  // namespace orthodyn
