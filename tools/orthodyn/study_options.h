// The options that all studies have: compare, sweep, stability.
#pragma once

#include <optional>
#include <string>

#include "tools/orthodyn/command_options.h"

namespace orthodyn {

struct StudyArguments {
  std::string file;
  std::optional<std::string> out;
  int jobs = 0;   // 0: as many as there are processors, by ranks
  int ranks = 1;  // that compute a piece together
  bool retry = false, quiet = false, no_report = false;
  bool yes = false;  // also for a million points and more
};

// What `--help` says of a study.
struct StudyWords {
  const char *name, *sentence;  // of its file
  const char* folder;           // below out/
  const char *table, *pieces;
};

void declare_study(StudyArguments& arguments, CommandOptions& options, const StudyWords& words);

void declare_yes(StudyArguments& arguments, CommandOptions& options);

// `piece`: "point".
void declare_ranks(StudyArguments& arguments, CommandOptions& options, const char* piece);

// `pieces`: "Points".
void declare_jobs(StudyArguments& arguments, CommandOptions& options, const char* pieces);

}  // namespace orthodyn
