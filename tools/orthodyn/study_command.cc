#include "tools/orthodyn/study_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "lib/simulation/output/output_size.h"
#include "lib/simulation/preflight/input_checks/input_checks.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/interrupt.h"
#include "tools/orthodyn/mpirun.h"
#include "tools/orthodyn/notice.h"

namespace orthodyn {

namespace fs = std::filesystem;

fs::path folder_for(const StudyArguments& arguments, const fs::path& usual, const std::string& name) {
  return arguments.out ? fs::path(*arguments.out) : usual / name;
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
  constexpr double kBytesOfPoint = 16e3;  // its scene, input and result, a block each
  if (arguments.yes || points < kMostUnasked) return;
  throw ConfigError(arguments.file,
                    fmt::format("makes {:.7g} points (about {} of disk); take fewer values, or add --yes if that is "
                                "meant",
                                points, shown_bytes(points * kBytesOfPoint)));
}

void SlipTeller::tell(const Config& scene) {
  for (const auto& slip : slips_of(scene))
    if (told_.insert(slip).second) fmt::print(stderr, "warning: {}\n", slip);
}

void use_one_thread_each() {
  for (const char* variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) setenv(variable, "1", 0);
}

void tell_of_interrupt(const char* pieces, const fs::path& folder) {
  fmt::print(stderr, "interrupted; the finished {} are in {} and will not be computed again\n", pieces,
             folder.string());
}

void show_report(const fs::path& folder, const StudyArguments& arguments) {
  take_time_to_end();
  if (arguments.no_report) put_report_aside(folder, arguments.quiet);
  else draw_report(folder, arguments.quiet);
}

}  // namespace orthodyn
