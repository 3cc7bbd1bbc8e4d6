#include "tools/orthodyn/job_array.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "lib/core/errors.h"
#include "lib/simulation/files.h"
#include "lib/study/jobs/job.h"

namespace orthodyn {

namespace {

// For a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// For a line #SBATCH.
std::string sbatch_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return out + "\"";
}

// The log beside the folder; SLURM takes a single '%' in it for a pattern.
std::string log_of(const ArrayJob& job) {
  std::string out;
  for (const char c : job.folder.string() + ".log") out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

// What a task needs beside the point in progress: the command that starts it, and the programs' code.
constexpr double kMargin = 512e6;

std::string command(const ArrayJob& job) {
  return fmt::format("{} sweep {} --out {}", quoted(job.program), quoted(job.sweep.string()),
                     quoted(job.folder.string()));
}

// Minutes that a task may take: every point until its process is killed, and the task's own look at all points.
long minutes(const ArrayJob& job) {
  constexpr double kOwn = 300;
  const double points = std::ceil(static_cast<double>(job.points) / static_cast<double>(job.tasks));
  return std::lround(std::ceil((points * (job.limits.seconds + study::kSetUpSeconds) + kOwn) / 60));
}

// What a command says; nothing if it fails.
std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return "";
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  return pclose(pipe) == 0 ? output.substr(0, output.find_first_of(";\n")) : "";
}

}  // namespace

std::string array_script(const ArrayJob& job) {
  return fmt::format(R"(#!/bin/sh
#SBATCH --job-name={}
#SBATCH --array=1-{}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --mem={}M
#SBATCH --time={}
#SBATCH --output={}
#SBATCH --open-mode=append
# {} points in {} tasks. A task that is lost or killed costs its points in progress: submit this script again, and only
# what is missing{} is done. Then join what is there:
#   {} --collect
exec {} --task "$SLURM_ARRAY_TASK_ID/{}" --jobs 1 --quiet{}
)",
                     sbatch_quoted(job.name), job.tasks,
                     std::lround(std::ceil((job.limits.memory + kMargin) / 1e6)), minutes(job),
                     sbatch_quoted(log_of(job)), job.points, job.tasks,
                     job.retry ? " or has failed" : "", command(job), command(job), job.tasks,
                     job.retry ? " --retry" : "");
}

int submit(const ArrayJob& job) {
  const auto script = job.folder.string() + ".sbatch";
  write_file(script, {array_script(job)});
  const std::string array = output_of("sbatch --parsable " + quoted(script));
  if (array.empty()) throw RunError("sbatch did not accept the job; its script is " + script);
  const std::string after =
      output_of(fmt::format("sbatch --parsable --job-name={} --output={} --open-mode=append --dependency=afterany:{} "
                            "--wrap {}",
                            quoted(job.name + "-collect"), quoted(log_of(job)), array,
                            quoted(command(job) + " --collect")));
  fmt::print("array   {} ({} tasks, {} points)\n", array, job.tasks, job.points);
  fmt::print("collect {}\n", after.empty() ? "by hand: " + command(job) + " --collect" : after);
  return 0;
}

}  // namespace orthodyn
