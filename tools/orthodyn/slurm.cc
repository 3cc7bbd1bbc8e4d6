#include "tools/orthodyn/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lib/core/errors.h"
#include "lib/simulation/output/files.h"
#include "lib/study/jobs/job.h"
#include "tools/orthodyn/mpirun.h"
#include "tools/orthodyn/plugins.h"

namespace orthodyn {

namespace {

std::string shell_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// Returns `text`, or throws ConfigError.
const std::string& require_no_control_characters(const std::string& text) {
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 127; };
  if (const auto at = std::find_if(text.begin(), text.end(), is_control); at != text.end())
    throw ConfigError("'" + std::string(text.begin(), at) +
                      "...': contains a line break or another control character, which is not allowed in a SLURM "
                      "script; rename the file, or name the result folder with --out");
  return text;
}

std::string sbatch_quoted(const std::string& text) {
  require_no_control_characters(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return out + "\"";
}

// Name of the log beside the folder. '%' is doubled, because SLURM reads a single one as the start of a pattern.
std::string log_beside(const std::filesystem::path& folder) {
  std::string out;
  for (const char c : folder.string() + ".log") out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

// A shell line that makes the job load the plugins loaded here; empty if there are none.
std::string exported_plugins() {
  const char* plugins = std::getenv(kPluginsVariable);
  return plugins ? std::string("export ") + kPluginsVariable + "=" + shell_quoted(plugins) + "\n" : "";
}

// A task needs more memory than its point, for the process that starts the point and for the program's code. Bytes.
constexpr double kMargin = 512e6;

std::string array_command(const ArrayJob& job) {
  return fmt::format("{} sweep {} --out {}{}", shell_quoted(job.program), shell_quoted(job.sweep.string()),
                     shell_quoted(job.folder.string()), job.ranks > 1 ? fmt::format(" --ranks {}", job.ranks) : "");
}

// The memory is given per processor for several ranks, because they may run on several nodes.
std::string memory_option(const ArrayJob& job) {
  const long megabytes = std::lround(std::ceil((job.limits.memory + kMargin) / job.ranks / 1e6));
  return fmt::format("{}={}", job.ranks > 1 ? "mem-per-cpu" : "mem", megabytes);
}

// Upper bound of a task's time: the time limits of its points, and 5 minutes to read all points.
long task_minutes(const ArrayJob& job) {
  constexpr double kReading = 300;
  const double points = std::ceil(static_cast<double>(job.points) / static_cast<double>(job.tasks));
  return std::lround(std::ceil((points * (job.limits.seconds + study::kSetUpSeconds) + kReading) / 60));
}

}  // namespace

std::string run_script(const RunJob& job) {
  std::string command = fmt::format("{} run {} --out {}", shell_quoted(job.program.string()),
                                    shell_quoted(job.scene.string()), shell_quoted(job.folder.string()));
  for (const auto& option : job.options) command += " " + shell_quoted(option);
  if (job.resumes) command += " --resume";
  std::string launch;
  const std::string timeout = job.ranks > 1 ? fmt::format("export {}={}\n", kKillTimeoutVariable, kKillTimeout) : "";
  if (job.ranks > 1) launch = fmt::format("mpirun -n {} ", job.ranks);
  if (job.ranks > 1 && job.threads > 1) launch += fmt::format("--map-by slot:PE={} ", job.threads);
  return fmt::format(
      R"(#!/bin/sh
#SBATCH --job-name={}
#SBATCH --ntasks={}
#SBATCH --cpus-per-task={}
#SBATCH --output={}
#SBATCH --open-mode=append
# Add what your cluster asks for: --time, --mem-per-cpu, --partition.
# {}
{}{}exec {}{} --quiet
)",
      sbatch_quoted(job.folder.filename().string()), job.ranks, job.threads, sbatch_quoted(log_beside(job.folder)),
      job.resumes
          ? "If the job is ended early, submit this script again: the run continues from its checkpoint."
          : "Add `checkpoint: {}` to the scene to let a job that was ended early continue when submitted again.",
      exported_plugins(), timeout, launch, command);
}

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
# {} points in {} tasks. A task that is killed loses only the points in progress: submit this script again to compute the
# missing{} points. Then collect the results:
#   {} --collect
{}exec {} --task "$SLURM_ARRAY_TASK_ID/{}" --jobs 1 --quiet{}
)",
                     sbatch_quoted(job.name), job.tasks, job.ranks, memory_option(job), task_minutes(job),
                     sbatch_quoted(log_beside(job.folder)), job.points, job.tasks, job.retry ? " and the failed" : "",
                     require_no_control_characters(array_command(job)), exported_plugins(), array_command(job),
                     job.tasks, job.retry ? " --retry" : "");
}

std::string submit_script(const std::filesystem::path& folder, const std::string& script) {
  const std::string file = folder.string() + ".sbatch";
  write_file(file, {script});
  const std::string job = first_output_line("sbatch --parsable " + shell_quoted(file));
  if (job.empty()) throw RunError("sbatch did not accept the job; the script is " + file);
  return job;
}

void submit_array(const ArrayJob& job) {
  const std::string array = submit_script(job.folder, array_script(job));
  const std::string after = first_output_line(
      fmt::format("sbatch --parsable --job-name={} --output={} --open-mode=append --dependency=afterany:{} --wrap {}",
                  shell_quoted(job.name + "-collect"), shell_quoted(log_beside(job.folder)), array,
                  shell_quoted(array_command(job) + " --collect")));
  fmt::print("array   {} ({} tasks, {} points)\n", array, job.tasks, job.points);
  fmt::print("collect {}\n", after.empty() ? "by hand: " + array_command(job) + " --collect" : after);
}

}  // namespace orthodyn
