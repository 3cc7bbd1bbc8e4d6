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

// The beginning of the command line of `ranks` of this program, of which `groups` run at a time; lets them share the
// processors, where there are fewer. Of one rank it is this program alone.
std::vector<std::string> program_on_ranks(int ranks, int groups);

// In place of this process, so that signals reach mpirun. `options` follow the program. Throws RunError if it cannot
// be started.
[[noreturn]] void go_on_as_ranks(int ranks, const std::vector<std::string>& options);

}  // namespace orthodyn
