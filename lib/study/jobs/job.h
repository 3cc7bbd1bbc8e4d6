// A piece of work in a process of its own: a folder with its input, in which `PROGRAM COMMAND FOLDER` leaves
// result.json.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lib/core/ranks.h"
#include "lib/simulation/output/json.h"
#include "lib/study/jobs/process.h"

namespace orthodyn::study {

// The files of a job's folder.
inline constexpr const char* kSceneFile = "scene.yaml";
inline constexpr const char* kInputFile = "job.json";
inline constexpr const char* kResultFile = "result.json";

// A process is killed when it has had the time of its runs and this much more for the set-up, s.
inline constexpr double kSetUpSeconds = 60;

struct Job {
  std::string title;    // "damped_beam, cvode_bdf, rtol 1e-3"
  std::string command;  // "measure"
  std::filesystem::path folder;
  std::string scene;  // scene.yaml, in YAML
  Json input;         // job.json
  ProcessLimits limits;
  // Whether the files that a result speaks of are whole, too. Empty: a result is all that a job leaves.
  std::function<bool(const Json& result)> is_whole = {};
};

// Has PROGRAM... COMMAND FOLDER do a job, whatever an earlier run has left. A process that died or reached a limit is a
// result, too (see job_result.h). Null if `stop` said so. Throws RunError if files cannot be written or no process can
// be started. Thread-safe for jobs of different folders; the thread must outlive its process, which dies with it.
Json run_job(const std::vector<std::string>& program, const Job& job, const Stop& stop);

// The other end, called by the process of COMMAND: reads job.json, does `work` and leaves its result in result.json
// with the time of day, "at". What goes wrong in the scene or in the run is a result; a ConfigError has the reason
// "refused". Throws RunError if that cannot be written, or if the program is another one than that which made the job.
// `ranks`: those that do it together, all of which call this; null for this process alone. One that fails alone throws.
void serve_job(const std::filesystem::path& folder, const std::function<Json(const Json& input)>& work,
               const Ranks* ranks = nullptr);

}  // namespace orthodyn::study
