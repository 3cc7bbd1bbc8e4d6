// A run as a job of SLURM, on one process or on several ranks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace orthodyn {

struct RunJob {
  std::filesystem::path program, scene, folder;
  std::vector<std::string> options;  // of `orthodyn run`, beside the folder
  int ranks = 1, threads = 1;        // threads of each rank
  bool goes_on = false;              // from its checkpoint, when it is submitted again
};

// For sbatch.
std::string run_script(const RunJob& job);

}  // namespace orthodyn
