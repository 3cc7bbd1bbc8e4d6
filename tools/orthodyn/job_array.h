// A sweep as a job array of SLURM: each task does its share of the points by itself.
#pragma once

#include <filesystem>
#include <string>

#include "lib/study/inputs/limits.h"

namespace orthodyn {

struct ArrayJob {
  std::string program;
  std::filesystem::path sweep, folder;
  std::string name;
  std::size_t points = 0, tasks = 0;
  Limits limits;       // of a point
  bool retry = false;  // what failed before
  int ranks = 1;       // that compute a point together
};

// For sbatch.
std::string array_script(const ArrayJob& job);

// Hands it to sbatch, and a job after it that collects; the exit code. Throws RunError if there is no sbatch.
int submit(const ArrayJob& job);

}  // namespace orthodyn
