#include "tools/orthodyn/run_job.h"

#include <fmt/format.h>

#include "tools/orthodyn/mpirun.h"
#include "tools/orthodyn/slurm.h"

namespace orthodyn {

std::string run_script(const RunJob& job) {
  std::string command = fmt::format("{} run {} --out {}", shell_quoted(job.program.string()),
                                    shell_quoted(job.scene.string()), shell_quoted(job.folder.string()));
  for (const auto& option : job.options) command += " " + shell_quoted(option);
  if (job.goes_on) command += " --resume";
  std::string launch;
  const std::string patience = job.ranks > 1 ? fmt::format("export {}={}\n", kPatienceVariable, kPatience) : "";
  if (job.ranks > 1) launch = fmt::format("mpirun -n {} ", job.ranks);
  if (job.ranks > 1 && job.threads > 1) launch += fmt::format("--map-by slot:PE={} ", job.threads);
  return fmt::format(R"(#!/bin/sh
#SBATCH --job-name={}
#SBATCH --ntasks={}
#SBATCH --cpus-per-task={}
#SBATCH --output={}
#SBATCH --open-mode=append
# Add what your cluster asks for: --time, --mem-per-cpu, --partition.
# {}
{}{}exec {}{} --quiet
)",
                     sbatch_quoted(job.folder.filename().string()), job.ranks, job.threads,
                     sbatch_quoted(log_beside(job.folder)),
                     job.goes_on ? "Submitted again after it was ended, it goes on from its checkpoint."
                                 : "With `checkpoint: {}` in the scene it would go on where it was ended.",
                     exported_plugins(), patience, launch, command);
}

}  // namespace orthodyn
