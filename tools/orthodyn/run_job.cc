#include "tools/orthodyn/run_job.h"

#include <fmt/format.h>

#include "tools/orthodyn/slurm.h"

namespace orthodyn {

std::string run_script(const RunJob& job) {
  std::string command = fmt::format("{} run {} --out {}", shell_quoted(job.program.string()),
                                    shell_quoted(job.scene.string()), shell_quoted(job.folder.string()));
  for (const auto& option : job.options) command += " " + shell_quoted(option);
  if (job.goes_on) command += " --resume";
  std::string launch;
  // Ranks that are to end have ten seconds for their checkpoint, where Open MPI would give them one.
  const char* const patience = job.ranks > 1 ? "export OMPI_MCA_odls_base_sigkill_timeout=10\n" : "";
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
