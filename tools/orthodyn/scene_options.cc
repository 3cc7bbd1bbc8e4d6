#include "tools/orthodyn/scene_options.h"

namespace orthodyn {

void declare_scene(SceneArguments& arguments, CommandOptions& options) {
  options.value("scene", arguments.scene, "A scene in YAML.").required().type("SCENE.yaml");
  options.repeated("--set", arguments.set, "Change a value by its path, e.g. materials.wood.young.0=12e9.")
      .type("PATH=VALUE");
  options.value("--integrator", arguments.integrator, "Short for --set integrator.type=NAME.");
}

}  // namespace orthodyn
