#include "tools/orthodyn/setup.h"

#include <fmt/format.h>

namespace orthodyn {

namespace {

Config read_config(const RunArguments& arguments) {
  Config config = Config::from_file(arguments.scene);
  if (arguments.integrator) config.override_with("integrator.type=" + *arguments.integrator);
  for (const auto& assignment : arguments.set) config.override_with(assignment);
  return config;
}

}  // namespace

Setup set_up(const RunArguments& arguments) {
  Setup setup = set_up(read_config(arguments));
  for (const auto& warning : setup.built.warnings) fmt::print(stderr, "warning: {}\n", warning);
  return setup;
}

}  // namespace orthodyn
