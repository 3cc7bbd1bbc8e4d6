#include "tools/orthodyn/study_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "lib/linear/solver.h"
#include "lib/simulation/slips/slips.h"
#include "lib/simulation/volume.h"
#include "tools/orthodyn/draw.h"
#include "tools/orthodyn/interrupt.h"
#include "tools/orthodyn/notice.h"
#include "tools/orthodyn/slurm.h"

namespace orthodyn {

namespace fs = std::filesystem;

fs::path this_program() { return fs::read_symlink("/proc/self/exe"); }

fs::path folder_for(const StudyArguments& arguments, const fs::path& usual, const std::string& name) {
  return arguments.out ? fs::path(*arguments.out) : usual / name;
}

namespace {

// Several groups of ranks may run at a time, of which Open MPI would bind the first ranks to the first cores; and more
// than there are cores, if that is asked for.
void let_ranks_share_cores(int processes) {
  for (const char* variable : {"OMPI_MCA_hwloc_base_binding_policy", "PRTE_MCA_hwloc_default_binding_policy"})
    setenv(variable, "none", 0);
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  if (processes <= cores) return;
  print_notice(fmt::format("warning: {} processes on {} processors: ranks wait for each other, and take many times as "
                           "long\n", processes, cores));
  for (const char* variable : {"OMPI_MCA_rmaps_base_oversubscribe", "OMPI_MCA_mpi_yield_when_idle"})
    setenv(variable, "1", 0);
}

bool is_on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

std::vector<std::string> program_of_jobs(const StudyArguments& arguments, int workers) {
  const std::string own = this_program().string();
  if (arguments.ranks == 1) return {own};
  let_ranks_share_cores(arguments.ranks * workers);
  return {"mpirun", "-n", std::to_string(arguments.ranks), own};
}

}  // namespace

study::JobQueue job_queue(const StudyArguments& arguments, int workers) {
  catch_interrupts();
  const auto failures = arguments.retry ? study::OldFailures::retry : study::OldFailures::keep;
  const auto warn = [](const std::string& text) { fmt::print(stderr, "warning: {}\n", text); };
  return {{program_of_jobs(arguments, workers), workers, failures, warn}, interrupted()};
}

int worker_count(const StudyArguments& arguments) {
  if (arguments.jobs > 0) return arguments.jobs;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / arguments.ranks);
}

void require_ranks(const StudyArguments& arguments) {
  if (arguments.ranks == 1) return;
  if (const auto& why = solver_registry().at("petsc").unavailable; !why.empty())
    throw ConfigError("--ranks: " + why);
  if (!is_on_path("mpirun")) throw ConfigError("--ranks: there is no mpirun on the PATH (Debian: openmpi-bin)");
  if (geteuid() == 0 && !std::getenv("OMPI_ALLOW_RUN_AS_ROOT") &&
      output_of("mpirun --version 2>&1").find("Open MPI") != std::string::npos)
    throw ConfigError("--ranks: as root, Open MPI asks for OMPI_ALLOW_RUN_AS_ROOT=1 and "
                      "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 in the environment");
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
  take_time_to_end();
  if (arguments.no_report) put_report_aside(folder, arguments.quiet);
  else draw_report(folder, arguments.quiet);
}

}  // namespace orthodyn
