// `orthodyn measure`: one point of a comparison, in a process of its own.
#include "lib/study/compare/measurement.h"
#include "tools/orthodyn/command.h"

namespace orthodyn {

namespace {

struct MeasureArguments {
  std::string folder;
};

int measure_folder(const MeasureArguments& arguments) {
  study::compare::measure(arguments.folder);
  return 0;
}

void declare(MeasureArguments& arguments, CommandOptions& options) {
  options.value("folder", arguments.folder).required();
}

const CommandRegistration measure_command(
    {.order = 41, .name = "measure", .sentence = "One point of a comparison; called by compare.", .hidden = true},
    declare, measure_folder);

}  // namespace

}  // namespace orthodyn
