// Runs a command on the MPI ranks that mpirun started. Messages are printed once. If one rank fails, all ranks end.
#pragma once

#include <functional>
#include <string>

#include "lib/core/ranks.h"

namespace orthodyn {

// Throws ConfigError if mpirun started several ranks of a command that is for one process (`on_ranks` false).
void require_one_rank_unless(bool on_ranks, const std::string& command);

// Call before printing an error that every rank has found. The other ranks wait 2 s, in which the first rank prints the
// error and exits and mpirun ends the others.
void let_first_rank_report();

// Returns the exit code of work(ranks); `ranks` is null without MPI. If all ranks throw, only the first rethrows; the
// others return its exit code.
int run_on_world_ranks(const std::function<int(const Ranks*)>& work);

// Prints this rank's error and ends all ranks.
[[noreturn]] void end_all_ranks(const Ranks& ranks, const std::string& message);

}  // namespace orthodyn
