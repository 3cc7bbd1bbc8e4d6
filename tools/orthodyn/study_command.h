// Options, result folder and actions that the study commands share: compare, sweep, converge and stability.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "lib/config/config.h"
#include "lib/simulation/output/folder_lock.h"
#include "lib/study/jobs/job_queue.h"
#include "tools/orthodyn/command_options.h"

namespace orthodyn {

struct StudyArguments {
  std::string file;
  std::optional<std::string> out;
  int jobs = 0;   // processes at a time; 0: number of processors / ranks
  int ranks = 1;  // of each point
  bool retry = false, quiet = false, no_report = false;
  bool yes = false;  // allow a million points and more
};

// Words of a study's --help.
struct StudyWords {
  const char *name, *sentence;  // of the positional argument, which is the study's file
  const char* folder;           // default result folder, below out/
  const char *table, *pieces;   // "sweep" for sweep.json; what the study computes: "points"
};

void declare_study(StudyArguments& arguments, CommandOptions& options, const StudyWords& words);

void declare_yes(StudyArguments& arguments, CommandOptions& options);

// `piece`: what the ranks compute together: "point".
void declare_ranks(StudyArguments& arguments, CommandOptions& options, const char* piece);

// `pieces`: what the processes compute: "points".
void declare_jobs(StudyArguments& arguments, CommandOptions& options, const char* pieces);

// The result folder of a study, locked against other processes.
class StudyFolder {
 public:
  // Creates the folder if it is missing. `kind`: "comparison"; `file`: the study's input. Throws ConfigError if the
  // folder holds other files, a study of another kind or file, or is used by another process (with `sharing`: except
  // by tasks that only add points). A study whose input file was edited can continue in its folder, because finished
  // points are found by their fingerprints.
  StudyFolder(std::filesystem::path path, const std::string& kind, const std::filesystem::path& file,
              Sharing sharing = Sharing::exclusive);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<FolderLock> lock_;  // taken after the folder has been checked
};

// --out if given, else `usual` / `name`.
std::filesystem::path folder_for(const StudyArguments& arguments, const std::filesystem::path& usual,
                                 const std::string& name);

// A queue that runs `workers` processes at a time and stops at the first interrupt.
study::JobQueue job_queue(const StudyArguments& arguments, int workers);

// Throws ConfigError if --ranks is above 1 and this build or machine cannot start several ranks.
void require_ranks(const StudyArguments& arguments);

// --jobs if given, else the number of processors / ranks, at least 1.
int worker_count(const StudyArguments& arguments);

// Limits BLAS and OpenMP to one thread in each process, unless the user's environment says otherwise.
void use_one_thread_each();

// Throws ConfigError for a million points and more without --yes.
void require_usual_number(const StudyArguments& arguments, double points);

// Prints input-check warnings (units and magnitudes) of a study's scenes to stderr, each once.
class InputWarningPrinter {
 public:
  // `is_timed`: false if only natural frequencies of the scene are computed.
  void print(const Config& scene, bool is_timed = true);

 private:
  std::set<std::string> printed_;
};

// Draws the folder's report; with --no-report, renames an earlier report to report.old.html instead.
void show_report(const std::filesystem::path& folder, const StudyArguments& arguments);

}  // namespace orthodyn
