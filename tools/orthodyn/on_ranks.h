// A command as one of several ranks that mpirun has started: it is told once what it has to tell, and when one of them
// cannot go on all end.
#pragma once

#include <functional>
#include <string>

#include "lib/core/ranks.h"

namespace orthodyn {

// Throws ConfigError where this process is one of several, and the command is not for that.
void require_one_rank_unless(bool on_ranks, const std::string& command);

// Before an error that all ranks have found, each for itself: later ranks wait while the first one tells it and ends,
// with which mpirun ends them.
void let_first_rank_tell();

// work(ranks), which is null for a process that is alone; returns its exit code. Exceptions that all ranks throw come
// from the first of them; the others return the exit code that belongs to it.
int on_world_ranks(const std::function<int(const Ranks*)>& work);

// Ends all ranks for what has happened to this one.
[[noreturn]] void end_all_ranks(const Ranks& ranks, const std::string& message);

}  // namespace orthodyn
