// A program run as a child process, with limits of time and memory that it cannot ignore.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace orthodyn {

struct ProcessLimits {
  double seconds = 0;  // of wall time, then it is killed
  double memory = 0;   // bytes in use, by all that it has started on this machine as well; then it is killed
};

struct ProcessEnd {
  enum class Kind { exited, signalled, timed_out, out_of_memory, interrupted };
  Kind kind = Kind::exited;
  int code = 0;  // exit code, or the signal
  bool succeeded() const { return kind == Kind::exited && code == 0; }
};

// Whether what is in progress is to be given up; asked every few milliseconds.
using Stop = std::function<bool()>;

// Runs argv[0] with its output going to `log`, and waits. When `stop` says so the child and all that it has started
// are killed. It dies with this process, too. Throws RunError if it cannot be started.
ProcessEnd run_process(const std::vector<std::string>& argv, const std::filesystem::path& log,
                       const ProcessLimits& limits, const Stop& stop);

}  // namespace orthodyn
