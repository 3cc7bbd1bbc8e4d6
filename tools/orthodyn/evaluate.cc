// `orthodyn evaluate`: one point of a sweep, in a process of its own.
#include "lib/study/sweep/evaluate_point.h"
#include "tools/orthodyn/command.h"

namespace orthodyn {

namespace {

struct EvaluateArguments {
  std::string folder;
};

int evaluate_folder(const EvaluateArguments& arguments) {
  study::sweep::evaluate_point(arguments.folder);
  return 0;
}

void declare(EvaluateArguments& arguments, CommandOptions& options) {
  options.value("folder", arguments.folder).required();
}

const CommandRegistration evaluate_command(
    {.order = 51, .name = "evaluate", .sentence = "One point of a sweep; called by sweep.", .hidden = true}, declare,
    evaluate_folder);

}  // namespace

}  // namespace orthodyn
