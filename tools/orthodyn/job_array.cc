#include "tools/orthodyn/job_array.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/study/jobs/job.h"
#include "tools/orthodyn/slurm.h"

namespace orthodyn {

namespace {

// What a task needs beside the point in progress: the command that starts it, and the programs' code.
constexpr double kMargin = 512e6;

std::string command(const ArrayJob& job) {
  return fmt::format("{} sweep {} --out {}{}", shell_quoted(job.program), shell_quoted(job.sweep.string()),
                     shell_quoted(job.folder.string()), job.ranks > 1 ? fmt::format(" --ranks {}", job.ranks) : "");
}

// Ranks may be on several nodes.
std::string memory(const ArrayJob& job) {
  const long megabytes = std::lround(std::ceil((job.limits.memory + kMargin) / job.ranks / 1e6));
  return fmt::format("{}={}", job.ranks > 1 ? "mem-per-cpu" : "mem", megabytes);
}

// Minutes that a task may take: every point until its process is killed, and the task's own look at all points.
long minutes(const ArrayJob& job) {
  constexpr double kOwn = 300;
  const double points = std::ceil(static_cast<double>(job.points) / static_cast<double>(job.tasks));
  return std::lround(std::ceil((points * (job.limits.seconds + study::kSetUpSeconds) + kOwn) / 60));
}

}  // namespace

std::string array_script(const ArrayJob& job) {
  return fmt::format(R"(#!/bin/sh
#SBATCH --job-name={}
#SBATCH --array=1-{}
#SBATCH --ntasks={}
#SBATCH --cpus-per-task=1
#SBATCH --{}M
#SBATCH --time={}
#SBATCH --output={}
#SBATCH --open-mode=append
# {} points in {} tasks. A task that is lost or killed costs its points in progress: submit this script again, and only
# what is missing{} is done. Then join what is there:
#   {} --collect
{}exec {} --task "$SLURM_ARRAY_TASK_ID/{}" --jobs 1 --quiet{}
)",
                     sbatch_quoted(job.name), job.tasks, job.ranks, memory(job), minutes(job),
                     sbatch_quoted(log_beside(job.folder)), job.points, job.tasks, job.retry ? " or has failed" : "",
                     one_line(command(job)), exported_plugins(), command(job), job.tasks, job.retry ? " --retry" : "");
}

int submit(const ArrayJob& job) {
  const std::string array = submit_script(job.folder, array_script(job));
  const std::string after =
      output_of(fmt::format("sbatch --parsable --job-name={} --output={} --open-mode=append --dependency=afterany:{} "
                            "--wrap {}",
                            shell_quoted(job.name + "-collect"), shell_quoted(log_beside(job.folder)), array,
                            shell_quoted(command(job) + " --collect")));
  fmt::print("array   {} ({} tasks, {} points)\n", array, job.tasks, job.points);
  fmt::print("collect {}\n", after.empty() ? "by hand: " + command(job) + " --collect" : after);
  return 0;
}

}  // namespace orthodyn
