// The parsed command line.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace orthodyn {

// Text to print instead of running a command: help (exit code 0) or an error (2).
struct Answer {
  int exit_code = 0;
  std::string out, err;  // for stdout and stderr
};

struct CommandLine {
  std::vector<std::string> plugins;  // shared libraries to load first
  std::function<int()> run;          // runs the command
  std::string name;                  // name of the command
  bool on_ranks = false;             // CommandText::on_ranks
  std::optional<Answer> answer;      // printed instead of running a command; empty if there is a command
};

CommandLine parse_command_line(int argc, char** argv);

}  // namespace orthodyn
