// SLURM batch scripts: a run as a job, a sweep as a job array.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/study/inputs/limits.h"

namespace orthodyn {

// A job that executes `orthodyn run` on one or several MPI ranks.
struct RunJob {
  std::filesystem::path program, scene, folder;
  std::vector<std::string> options;  // of `orthodyn run`, except --out and --resume
  int ranks = 1, threads = 1;        // threads of each rank
  bool resumes = false;              // continues from the checkpoint, so the script can be submitted again
};

// A job array that executes `orthodyn sweep`; each task of the array computes a part of the points.
struct ArrayJob {
  std::string program;
  std::filesystem::path sweep, folder;
  std::string name;
  std::size_t points = 0, tasks = 0;
  Limits limits;       // time and memory of one point
  bool retry = false;  // recompute points that failed before
  int ranks = 1;       // MPI ranks of one point
};

// The text of a script. Both throw ConfigError if a name contains control characters, because text after a line break
// would be run as a command.
std::string run_script(const RunJob& job);
std::string array_script(const ArrayJob& job);

// Writes the script to <folder>.sbatch, submits it and returns the job's number. Throws RunError if sbatch fails.
std::string submit_script(const std::filesystem::path& folder, const std::string& script);

// Submits the array and a job that runs `sweep --collect` after it; prints their numbers. Throws RunError if sbatch
// fails.
void submit_array(const ArrayJob& job);

}  // namespace orthodyn
