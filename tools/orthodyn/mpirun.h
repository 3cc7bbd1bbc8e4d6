// Starts several MPI ranks of this program with mpirun.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace orthodyn {

// Path of the running executable.
std::filesystem::path this_program();

// Throws ConfigError if this build has no MPI, mpirun is missing, or Open MPI would refuse to run as root.
void require_mpirun();

// Seconds between Open MPI's SIGTERM and SIGKILL, in which ranks write their checkpoint. Open MPI's default of 1 s is
// too short, because a rank takes up to 4 s to end by itself (interrupt.cc).
inline constexpr const char* kKillTimeoutVariable = "OMPI_MCA_odls_base_sigkill_timeout";
inline constexpr const char* kKillTimeout = "5";

// The command line that starts this program on `ranks` ranks, without mpirun if `ranks` is 1.
std::vector<std::string> program_on_ranks(int ranks);

// Sets mpirun's environment for `groups` simultaneous groups of `ranks` ranks each on this machine. Allows more ranks
// than processors, with a warning, except in a SLURM job, where SLURM's allocation is the limit.
void let_ranks_share_processors(int ranks, int groups);

// Replaces this process by mpirun, so that signals reach mpirun. `words`: arguments of the program on each rank. Throws
// RunError if mpirun cannot be started.
[[noreturn]] void exec_on_ranks(int ranks, const std::vector<std::string>& words);

// First line of the output of a shell command, up to ';' or a line break; empty if the command fails.
std::string first_output_line(const std::string& command);

}  // namespace orthodyn
