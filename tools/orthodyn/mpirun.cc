#include "tools/orthodyn/mpirun.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>

#include "lib/core/errors.h"
#include "lib/linear/solver.h"
#include "tools/orthodyn/print_nothrow.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

bool is_on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

fs::path this_program() { return fs::read_symlink("/proc/self/exe"); }

void require_mpirun() {
  if (const auto& why = solver_registry().at("petsc").unavailable; !why.empty()) throw ConfigError("--ranks: " + why);
  if (!is_on_path("mpirun")) throw ConfigError("--ranks: mpirun is not on the PATH; install it (Debian: openmpi-bin)");
  if (geteuid() == 0 && !std::getenv("OMPI_ALLOW_RUN_AS_ROOT") &&
      first_output_line("mpirun --version 2>&1").find("Open MPI") != std::string::npos)
    throw ConfigError(
        "--ranks: Open MPI refuses to run as root; set OMPI_ALLOW_RUN_AS_ROOT=1 and OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
        "in the environment, or use another account");
}

std::vector<std::string> program_on_ranks(int ranks) {
  const std::string own = this_program().string();
  if (ranks == 1) return {own};
  return {"mpirun", "-n", std::to_string(ranks), own};
}

// By default Open MPI binds the ranks of every group to the same first processors, and starts no more ranks than there
// are processors. Versions 4 and 5 read different variables, so both are set.
void let_ranks_share_processors(int ranks, int groups) {
  if (ranks == 1) return;
  const long processes = static_cast<long>(ranks) * groups, processors = std::thread::hardware_concurrency();
  const bool are_too_many = processes > processors && !std::getenv("SLURM_JOB_ID");
  if (groups > 1 || are_too_many)
    for (const char* variable : {"OMPI_MCA_hwloc_base_binding_policy", "PRTE_MCA_hwloc_default_binding_policy"})
      setenv(variable, "none", 0);
  if (!are_too_many) return;
  print_nothrow(
      fmt::format("warning: {} processes share {} processors: ranks wait for each other and run many times slower; use "
                  "fewer --ranks or --jobs\n",
                  processes, processors));
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 0);
  setenv("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe", 0);
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
}

void exec_on_ranks(int ranks, const std::vector<std::string>& words) {
  require_mpirun();
  let_ranks_share_processors(ranks, 1);
  std::vector<std::string> line = program_on_ranks(ranks);
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : line) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  setenv(kKillTimeoutVariable, kKillTimeout, 0);
  sigset_t none;  // blocked signals would be inherited
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execvp(arguments.front(), arguments.data());
  throw RunError(fmt::format("cannot start mpirun: {}", std::strerror(errno)));
}

std::string first_output_line(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return "";
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  return pclose(pipe) == 0 ? output.substr(0, output.find_first_of(";\n")) : "";
}

}  // namespace orthodyn
