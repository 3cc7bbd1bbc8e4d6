#include "tools/orthodyn/study_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "lib/core/errors.h"
#include "lib/simulation/preflight/input_checks/input_checks.h"
#include "lib/simulation/preflight/output_size.h"
#include "lib/study/jobs/json_values.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/interrupt.h"
#include "tools/orthodyn/mpirun.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// Name of the lock file, which is the first file in a study's folder and shows the study's kind.
std::string mark_of(const std::string& kind) { return ".orthodyn-" + kind; }

void refuse_other_folders(const fs::path& path, const std::string& kind) {
  std::error_code ec;
  if (!fs::exists(path, ec)) return;
  if (!fs::is_directory(path, ec))
    throw ConfigError(path.string(), "is a file; name a folder for the results with --out");
  if (fs::is_empty(path, ec) || fs::exists(path / mark_of(kind), ec)) return;
  throw ConfigError(path.string(),
                    fmt::format("holds files that are not of a {}; name another folder with --out", kind));
}

// Throws ConfigError if the folder's table names the file of another study. A file that no longer exists is accepted,
// because it may have been renamed.
void refuse_other_studies(const fs::path& path, const std::string& kind, const fs::path& file) {
  const Json table = read_json(path / (kind == "comparison" ? "compare.json" : kind + ".json"));
  if (!table.is_object() || !table.contains("file")) return;
  const std::string earlier = table.at("file");
  std::error_code ec;
  if (!fs::exists(earlier, ec) || fs::equivalent(earlier, file, ec)) return;
  throw ConfigError(
      path.string(),
      fmt::format("holds the results of {}, which those of {} would replace; name another folder with --out", earlier,
                  file.string()));
}

}  // namespace

void declare_study(StudyArguments& arguments, CommandOptions& options, const StudyWords& words) {
  options.value(words.name, arguments.file, words.sentence).required().type("FILE.yaml");
  options.value("--out", arguments.out, fmt::format("Folder for the results; default out/{}/<name>.", words.folder))
      .type("DIR");
  options.flag("--retry", arguments.retry,
               fmt::format("Compute {} that failed in an earlier run again.", words.pieces));
  options.flag("--quiet", arguments.quiet, "Print warnings and errors only.");
  options.flag("--no-report", arguments.no_report,
               fmt::format("Write {}.json and the tables, but no HTML report.", words.table));
}

void declare_yes(StudyArguments& arguments, CommandOptions& options) {
  options.flag("--yes", arguments.yes, "Allow a million points and more.");
}

void declare_jobs(StudyArguments& arguments, CommandOptions& options, const char* pieces) {
  options
      .value("--jobs", arguments.jobs,
             fmt::format("Number of {} to compute at a time, each in a process; default: the number of processors.",
                         pieces))
      .range(1, 1024);
}

void declare_ranks(StudyArguments& arguments, CommandOptions& options, const char* piece) {
  options
      .value(
          "--ranks", arguments.ranks,
          fmt::format("MPI ranks that compute each {} together, as `mpirun -n N orthodyn run` does; default 1.", piece))
      .range(1, 1'000'000);
}

fs::path folder_for(const StudyArguments& arguments, const fs::path& usual, const std::string& name) {
  return arguments.out ? fs::path(*arguments.out) : usual / name;
}

StudyFolder::StudyFolder(fs::path path, const std::string& kind, const fs::path& file, Sharing sharing)
    : path_(std::move(path)) {
  refuse_other_folders(path_, kind);
  refuse_other_studies(path_, kind, file);
  lock_.emplace(path_, mark_of(kind), kind, sharing);
  if (!lock_->warning().empty()) fmt::print(stderr, "warning: {}\n", lock_->warning());
}

study::JobQueue job_queue(const StudyArguments& arguments, int workers) {
  catch_interrupts();
  const auto failures = arguments.retry ? study::OldFailures::retry : study::OldFailures::keep;
  const auto warn = [](const std::string& text) { fmt::print(stderr, "warning: {}\n", text); };
  let_ranks_share_processors(arguments.ranks, workers);
  return {{program_on_ranks(arguments.ranks), workers, failures, warn}, interrupted()};
}

int worker_count(const StudyArguments& arguments) {
  if (arguments.jobs > 0) return arguments.jobs;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / arguments.ranks);
}

void require_ranks(const StudyArguments& arguments) {
  if (arguments.ranks > 1) require_mpirun();
}

void require_usual_number(const StudyArguments& arguments, double points) {
  constexpr double kBytesOfPoint = 16e3;  // scene, input and result take a disk block each
  if (arguments.yes || points < kConfirmationThreshold) return;
  throw ConfigError(arguments.file,
                    fmt::format("makes {:.7g} points (about {} of disk); use fewer values, or --yes to allow it",
                                points, shown_bytes(points * kBytesOfPoint)));
}

void InputWarningPrinter::print(const Config& scene, bool is_timed) {
  for (const auto& warning : scene_warnings(scene, is_timed))
    if (printed_.insert(warning).second) fmt::print(stderr, "warning: {}\n", warning);
}

void use_one_thread_each() {
  for (const char* variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) setenv(variable, "1", 0);
}

void show_report(const fs::path& folder, const StudyArguments& arguments) {
  cancel_time_limit();
  if (arguments.no_report) rename_old_report(folder, arguments.quiet);
  else draw_report(folder, arguments.quiet);
}

}  // namespace orthodyn
