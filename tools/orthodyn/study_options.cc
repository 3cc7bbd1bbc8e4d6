#include "tools/orthodyn/study_options.h"

#include <fmt/format.h>

namespace orthodyn {

void declare_study(StudyArguments& arguments, CommandOptions& options, const StudyWords& words) {
  options.value(words.name, arguments.file, words.sentence).required().type("FILE.yaml");
  options.value("--out", arguments.out, fmt::format("Folder for the results; default out/{}/<name>.", words.folder))
      .type("DIR");
  options.flag("--retry", arguments.retry, fmt::format("Try {} again that failed in an earlier run.", words.pieces));
  options.flag("--quiet", arguments.quiet, "Say nothing but errors.");
  options.flag("--no-report", arguments.no_report, fmt::format("Write {0}.json and {0}.csv only.", words.table));
}

void declare_yes(StudyArguments& arguments, CommandOptions& options) {
  options.flag("--yes", arguments.yes, "Also for a million points and more.");
}

void declare_jobs(StudyArguments& arguments, CommandOptions& options, const char* pieces) {
  options
      .value("--jobs", arguments.jobs, fmt::format("{} at a time, each in a process; default one a processor.", pieces))
      .range(1, 1024);
}

void declare_ranks(StudyArguments& arguments, CommandOptions& options, const char* piece) {
  options
      .value(
          "--ranks", arguments.ranks,
          fmt::format("Processes that compute a {} together, as `mpirun -n N orthodyn run` does; default one.", piece))
      .range(1, 1'000'000);
}

}  // namespace orthodyn
