// mpirun, as commands start it: several ranks of this program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace orthodyn {

// This executable.
std::filesystem::path this_program();

// Throws ConfigError where this build cannot compute on several ranks, or mpirun would not start them.
void require_mpirun();

// Seconds that mpirun gives ranks for their checkpoint when they are to end: by then they end by themselves
// (interrupt.cc), where Open MPI would give them one.
inline constexpr const char* kPatienceVariable = "OMPI_MCA_odls_base_sigkill_timeout";
inline constexpr const char* kPatience = "5";

// Words that start this program on so many ranks; without mpirun for one.
std::vector<std::string> program_on_ranks(int ranks);

// Sets the environment of mpirun for `groups` of so many ranks at a time on this machine, and warns where there are
// more than processors. In a job of SLURM, which knows how many there are, no more are started than it allows.
void let_ranks_share_processors(int ranks, int groups);

// mpirun in place of this process, so that signals reach it. `words`: of the ranks' command line, after the program.
// Throws RunError if it cannot be started.
[[noreturn]] void go_on_as_ranks(int ranks, const std::vector<std::string>& words);

}  // namespace orthodyn
