// What the commands of studies share: compare, sweep and stability.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "lib/config/config.h"
#include "lib/study/jobs/job_queue.h"
#include "tools/orthodyn/study_options.h"

namespace orthodyn {

// --out, or else `usual` / `name`.
std::filesystem::path folder_for(const StudyArguments& arguments, const std::filesystem::path& usual,
                                 const std::string& name);

// A queue that an interrupt ends, with `workers` processes at a time.
study::JobQueue job_queue(const StudyArguments& arguments, int workers);

// Throws ConfigError where this build cannot compute on as many ranks as were asked for.
void require_ranks(const StudyArguments& arguments);

// As many workers as were asked for, or as many as there are processors for their ranks.
int worker_count(const StudyArguments& arguments);

// Processes that share the processors must not each start a thread of BLAS for every one of them.
void use_one_thread_each();

// Throws ConfigError for a million points and more, unless --yes was said.
void require_usual_number(const StudyArguments& arguments, double points);

// Slips of unit and magnitude in scenes of a study, on stderr: each once.
class SlipTeller {
 public:
  void tell(const Config& scene);

 private:
  std::set<std::string> told_;
};

// `pieces`: "points".
void tell_of_interrupt(const char* pieces, const std::filesystem::path& folder);

// Draws the report of a folder, or puts an earlier one aside if none is wanted.
void show_report(const std::filesystem::path& folder, const StudyArguments& arguments);

}  // namespace orthodyn
