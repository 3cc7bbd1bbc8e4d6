#include "tools/orthodyn/study_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <thread>

#include "lib/simulation/slips/slips.h"
#include "lib/simulation/volume.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/interrupt.h"

namespace orthodyn {

namespace fs = std::filesystem;

fs::path this_program() { return fs::read_symlink("/proc/self/exe"); }

fs::path folder_for(const StudyArguments& arguments, const fs::path& usual, const std::string& name) {
  return arguments.out ? fs::path(*arguments.out) : usual / name;
}

study::JobQueue job_queue(const StudyArguments& arguments, int workers) {
  catch_interrupts();
  const auto failures = arguments.retry ? study::OldFailures::retry : study::OldFailures::keep;
  const auto warn = [](const std::string& text) { fmt::print(stderr, "warning: {}\n", text); };
  return {{this_program().string(), workers, failures, warn}, interrupted()};
}

int worker_count(const StudyArguments& arguments) {
  return arguments.jobs > 0 ? arguments.jobs : static_cast<int>(std::thread::hardware_concurrency());
}

void require_usual_number(const StudyArguments& arguments, double points) {
  constexpr double kBytesOfPoint = 16e3;  // its scene, input and result, a block each
  if (arguments.yes || points < kMostUnasked) return;
  throw ConfigError(arguments.file,
                    fmt::format("makes {:.7g} points (about {} of disk); take fewer values, or add --yes if that is "
                                "meant", points, shown_bytes(points * kBytesOfPoint)));
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
  if (arguments.no_report) put_report_aside(folder, arguments.quiet);
  else draw_report(folder, arguments.quiet);
}

}  // namespace orthodyn
