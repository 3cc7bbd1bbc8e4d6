#include "tools/orthodyn/scene_options.h"

#include <fmt/format.h>

namespace orthodyn {

void declare_scene(SceneArguments& arguments, CommandOptions& options) {
  options.value("scene", arguments.scene, "A scene in YAML.").required().type("SCENE.yaml");
  options
      .repeated("--set", arguments.changes.set,
                "Change a value of the scene by its path, e.g. materials.wood.young.0=12e9.")
      .type("PATH=VALUE");
  options.value("--integrator", arguments.changes.integrator,
                "Use this integrator instead of the scene's; keys that it does not have are left out.");
}

namespace {

Config read_with_notice(const std::string& file, const SceneChanges& changes) {
  std::vector<std::string> left_out;
  Config scene = read_scene_file(file, changes, &left_out);
  if (const auto sentence = left_out_sentence(left_out, changes); !sentence.empty())
    fmt::print(stderr, "notice: {}\n", sentence);
  return scene;
}

Setup set_up_and_warn(const Config& scene, bool is_timed) {
  Setup setup = set_up(scene, false, is_timed);
  for (const auto& warning : setup.built.warnings) fmt::print(stderr, "warning: {}\n", warning);
  return setup;
}

}  // namespace

SetupOfAnyTime set_up_without_time(const std::string& file, const SceneChanges& changes, bool uses_time) {
  Config scene = read_with_notice(file, changes);
  const bool timed = scene.is_map() && (scene.has("time") || scene.has("analysis"));
  if (scene.is_map() && !timed) {
    fmt::print(stderr, "notice: the scene has no 'time', which a run needs; assuming 1 s\n");
    scene.set("time.end", 1.0);
  }
  return {set_up_and_warn(scene, timed && uses_time), timed};
}

}  // namespace orthodyn
