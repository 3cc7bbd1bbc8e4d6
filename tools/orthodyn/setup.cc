#include "tools/orthodyn/setup.h"

#include <fmt/format.h>

#include "lib/simulation/input_kind.h"

namespace orthodyn {

Config read_config(const std::string& file, const std::optional<std::string>& integrator,
                   const std::vector<std::string>& assignments) {
  Config config = Config::from_file(file);
  refuse_other_kinds(config, InputFile::scene);
  if (integrator) config.override_with("integrator.type=" + *integrator);
  for (const auto& assignment : assignments) config.override_with(assignment);
  return config;
}

Setup set_up_and_warn(Config config) {
  Setup setup = set_up(std::move(config));
  for (const auto& warning : setup.built.warnings) fmt::print(stderr, "warning: {}\n", warning);
  return setup;
}

Setup set_up(const SceneArguments& arguments) {
  return set_up_and_warn(read_config(arguments.scene, arguments.integrator, arguments.set));
}

}  // namespace orthodyn
