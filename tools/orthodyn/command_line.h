// The command line, parsed: which command it names, with its options set.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace orthodyn {

struct CommandLine {
  std::vector<std::string> plugins;  // shared libraries to load first
  std::function<int()> run;          // the command
  std::string name;                  // of it
  bool on_ranks = false;             // CommandText::on_ranks
  std::optional<int> exit_code;      // nothing is to be run: help was printed (0), or what is wrong (2)
};

CommandLine parse_command_line(int argc, char** argv);

}  // namespace orthodyn
