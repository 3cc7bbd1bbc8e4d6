// run.json: scene, machine, outcome and cost of a run. It is written first, with the status "running": it marks the
// folder as a result, and keeps this status if the run is killed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/config/config.h"
#include "lib/simulation/checkpoint/checkpoint.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/output/json.h"
#include "lib/simulation/run/run_result.h"

namespace orthodyn {

inline constexpr const char* kRunRecordFile = "run.json";  // in the result folder

class RunRecord {
 public:
  // Writes the file. `scene`: file name; `set`: assignments to the scene; `resolved`: the scene with all defaults,
  // whose model sections become `model.given`. Throws RunError.
  RunRecord(const std::filesystem::path& folder, const std::string& scene, const std::vector<std::string>& set,
            const std::vector<Restart>& restarts, const Config& resolved);

  // Completes the file. Works on a full disk, because space was reserved. Throws RunError.
  void finish(const RunResult& result) const;

 private:
  Json begin_;  // the part known at the start
  ReservedFile file_;
};

}  // namespace orthodyn
