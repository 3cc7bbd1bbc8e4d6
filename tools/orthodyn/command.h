// A subcommand of `orthodyn`. Each has a file of its own, which declares it and registers it:
//
//   void declare(ConvertArguments& arguments, CommandOptions& options) {
//     options.flag("--force", arguments.force, "Replace existing files.");
//   }
//   int convert(const ConvertArguments& arguments) { ... return 0; }
//   const CommandRegistration convert_command({.order = 80, .name = "convert", .sentence = "..."}, declare, convert);
//
// A command returns the exit code of the program: 0 done, 1 an expectation was missed, 2 the input is at fault, 3 it
// could not go on, 130 interrupted. It may throw: main.cc turns ConfigError into 2 and all else into 3.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/orthodyn/command_options.h"

namespace orthodyn {

struct CommandText {
  int order = 0;  // in `orthodyn --help`, ascending
  std::string name, sentence;
  std::string examples = {};  // a line each, for `orthodyn NAME --help`
  bool hidden = false;        // called by other commands, not listed
  bool on_ranks = false;      // may be one of several ranks, started by mpirun
};

struct Command {
  CommandText text;
  // Declares the options, and returns what runs the command once they are parsed.
  std::function<std::function<int()>(CommandOptions&)> declare;
};

// All that are registered, in their order.
std::vector<Command> commands();

// To be a constant at namespace scope. `Arguments` holds what the options set, as it is where none is given.
class CommandRegistration {
 public:
  template <class Arguments>
  CommandRegistration(CommandText text, void (*declare)(Arguments&, CommandOptions&), int (*run)(const Arguments&)) {
    add({std::move(text), [declare, run](CommandOptions& options) -> std::function<int()> {
           const auto arguments = std::make_shared<Arguments>();
           declare(*arguments, options);
           return [arguments, run] { return run(*arguments); };
         }});
  }

 private:
  static void add(Command command);
};

}  // namespace orthodyn
