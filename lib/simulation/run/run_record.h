// run.json: what was run, where, how it ended and what it has cost. It is written first of all, with the status
// "running": a folder with it is a result of ours, and a run that was killed leaves it so.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/simulation/checkpoint/checkpoint.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/output/json.h"
#include "lib/simulation/run/run_result.h"

namespace orthodyn {

inline constexpr const char* kRunRecordFile = "run.json";  // in the folder of the results

class RunRecord {
 public:
  // Writes the file. `scene`: its file, `set`: what was changed in it, `given`: of its model (model_keys.h). Throws
  // RunError.
  RunRecord(const std::filesystem::path& folder, const std::string& scene, const std::vector<std::string>& set,
            const std::vector<Restart>& restarts, const Json& given);

  // Throws RunError, but not for a full disk: its room is reserved.
  void finish(const RunResult& result) const;

 private:
  Json begin_;  // what is known at the start
  ReservedFile file_;
};

}  // namespace orthodyn
