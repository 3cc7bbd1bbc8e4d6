// A subcommand of `orthodyn`. Each is declared and registered in its own file:
//
//   void declare(ConvertArguments& arguments, CommandOptions& options) {
//     options.flag("--force", arguments.force, "Replace existing files.");
//   }
//   int convert(const ConvertArguments& arguments) { ... return 0; }
//   const CommandRegistration convert_command({.order = 80, .name = "convert", .sentence = "..."}, declare, convert);
//
// A command returns the exit code of the program: 0 done, 1 an expectation was missed, 2 input error, 3 computation
// failed, 130 interrupted. Exceptions: main.cc turns ConfigError into 2 and all others into 3.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/orthodyn/command_options.h"

namespace orthodyn {

struct CommandText {
  int order = 0;  // position in `orthodyn --help`, ascending
  std::string name, sentence;
  std::string examples = {};  // lines of `orthodyn NAME --help`
  bool hidden = false;        // called by other commands; not listed
  bool on_ranks = false;      // may run on several MPI ranks
};

struct Command {
  CommandText text;
  // Declares the options; returns the function that runs the command after parsing.
  std::function<std::function<int()>(CommandOptions&)> declare;
};

// All registered commands, sorted by `order`.
std::vector<Command> commands();

// Define a constant of this type at namespace scope. `Arguments` is default constructed, then set by the options.
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
