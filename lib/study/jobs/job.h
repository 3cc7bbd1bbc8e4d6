// A job: work done in its own process. The job's folder holds the input; `PROGRAM COMMAND FOLDER` writes result.json
// there.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lib/config/config.h"
#include "lib/core/ranks.h"
#include "lib/simulation/output/json.h"
#include "lib/study/jobs/process.h"

namespace orthodyn::study {

// Files in a job's folder.
inline constexpr const char* kSceneFile = "scene.yaml";
inline constexpr const char* kInputFile = "job.json";
inline constexpr const char* kResultFile = "result.json";

// Wall time (s) that a job may take in addition to its runs, for the set-up.
inline constexpr double kSetUpSeconds = 60;

struct Job {
  std::string title;    // "damped_beam, cvode_bdf, rtol 0.001"
  std::string command;  // "measure"
  std::filesystem::path folder;
  std::string scene;  // content of scene.yaml
  Json input;         // content of job.json
  ProcessLimits limits;
  // True if the other files of the result are complete. Empty if result.json is the only file.
  std::function<bool(const Json& result)> is_whole = {};
};

// Runs `PROGRAM... COMMAND FOLDER`, replacing an earlier result. If the process crashes or reaches a limit, the result
// is a failure (see job_result.h). Returns null if `stop` returned true. Throws RunError if files cannot be written or
// no process can be started. Thread-safe for jobs in different folders. The process is killed if the calling thread
// ends.
Json run_job(const std::vector<std::string>& program, const Job& job, const Stop& stop);

// Does the job in `folder`; called in the process of COMMAND. Reads job.json, calls `work`, and writes its result and
// the time, as "at", to result.json. Errors of the scene or of the run become failed results; the reason of a
// ConfigError is "refused". Throws RunError if the result cannot be written or the job was made by another version of
// the program. `ranks`: the processes that share the job; each must call this function. Null for one process. Throws
// std::runtime_error if this rank fails alone.
void serve_job(const std::filesystem::path& folder, const std::function<Json(const Json& input)>& work,
               const Ranks* ranks = nullptr);

// Fingerprint of a scene's mesh, with all files that the mesh file refers to (.ele beside .node, the includes of a
// .veg). If the mesh cannot be loaded, returns the error message; the job itself then reports the error.
std::string mesh_hash(const Config& scene);

}  // namespace orthodyn::study
