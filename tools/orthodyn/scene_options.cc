#include "tools/orthodyn/scene_options.h"

#include <fmt/format.h>

namespace orthodyn {

void declare_scene(SceneArguments& arguments, CommandOptions& options) {
  options.value("scene", arguments.scene, "A scene in YAML.").required().type("SCENE.yaml");
  options.repeated("--set", arguments.changes.set, "Change a value by its path, e.g. materials.wood.young.0=12e9.")
      .type("PATH=VALUE");
  options.value("--integrator", arguments.changes.integrator, "Short for --set integrator.type=NAME.");
}

Setup set_up_and_warn(const std::string& scene, const SceneChanges& changes) {
  Setup setup = set_up(read_scene_file(scene, changes));
  for (const auto& warning : setup.built.warnings) fmt::print(stderr, "warning: {}\n", warning);
  return setup;
}

}  // namespace orthodyn
