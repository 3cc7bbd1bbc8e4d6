// Runs a program as a child process with enforced limits of time and memory.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace orthodyn {

struct ProcessLimits {
  double seconds = 0;  // wall time
  double memory = 0;   // resident bytes of the process and its descendants on this machine
};

struct ProcessEnd {
  enum class Kind { exited, signalled, timed_out, out_of_memory, interrupted };
  Kind kind = Kind::exited;
  int code = 0;  // exit code (127 if argv[0] cannot run), or the signal
  bool succeeded() const { return kind == Kind::exited && code == 0; }
};

// True to kill the process; called every few milliseconds.
using Stop = std::function<bool()>;

// Runs argv[0] with its output going to `log`, and waits. Kills the child and its descendants at a limit or when `stop`
// returns true. The kernel kills the child if the calling thread ends. Throws RunError if no process can be created.
ProcessEnd run_process(const std::vector<std::string>& argv, const std::filesystem::path& log,
                       const ProcessLimits& limits, const Stop& stop);

}  // namespace orthodyn
