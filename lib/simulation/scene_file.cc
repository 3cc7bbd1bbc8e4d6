#include "lib/simulation/scene_file.h"

#include "lib/simulation/input_kind.h"

namespace orthodyn {

Config read_scene_file(const std::string& file, const SceneChanges& changes) {
  Config scene = Config::from_file(file);
  refuse_other_kinds(scene, InputFile::scene);
  if (changes.integrator) scene.set("integrator.type", *changes.integrator);
  for (const auto& assignment : changes.set) scene.override_with(assignment);
  return scene;
}

}  // namespace orthodyn
