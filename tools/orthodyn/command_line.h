// The command line, parsed: which command it names, with its options set.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace orthodyn {

// Where nothing is to be run: help (0), or what is wrong (2).
struct Answer {
  int exit_code = 0;
  std::string out, err;  // for the two streams
};

struct CommandLine {
  std::vector<std::string> plugins;  // shared libraries to load first
  std::function<int()> run;          // the command
  std::string name;                  // of it
  bool on_ranks = false;             // CommandText::on_ranks
  std::optional<Answer> answer;      // then nothing else counts
};

CommandLine parse_command_line(int argc, char** argv);

}  // namespace orthodyn
