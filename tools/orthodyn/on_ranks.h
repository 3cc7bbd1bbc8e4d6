// A command as one of several ranks that mpirun has started: it is told once what it has to tell, and when one of them
// cannot go on all end.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lib/core/ranks.h"
#include "tools/orthodyn/command_line.h"

namespace orthodyn {

// What is wrong with a command line where this process is one of several, and the command is not for that.
std::optional<Answer> refusal_on_ranks(const CommandLine& line);

// Prints it, once for all ranks; returns its exit code.
int tell_once(const Answer& answer);

// work(ranks), which is null for a process that is alone; returns its exit code. Exceptions that all ranks throw come
// from the first of them; the others return the exit code that belongs to it.
int on_world_ranks(const std::function<int(const Ranks*)>& work);

// Ends all ranks for what has happened to this one.
[[noreturn]] void end_all_ranks(const Ranks& ranks, const std::string& message);

}  // namespace orthodyn
