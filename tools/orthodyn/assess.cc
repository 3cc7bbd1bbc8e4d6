// `orthodyn assess`: one trial of a stability matrix, in a process of its own.
#include "lib/study/stability/evaluate_case.h"
#include "tools/orthodyn/command.h"

namespace orthodyn {

namespace {

struct AssessArguments {
  std::string folder;
};

int assess_folder(const AssessArguments& arguments) {
  study::stability::evaluate_case(arguments.folder);
  return 0;
}

void declare(AssessArguments& arguments, CommandOptions& options) {
  options.value("folder", arguments.folder).required();
}

const CommandRegistration assess_command(
    {.order = 61, .name = "assess", .sentence = "One trial of a matrix; called by stability.", .hidden = true}, declare,
    assess_folder);

}  // namespace

}  // namespace orthodyn
