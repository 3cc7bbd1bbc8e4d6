// Converts an Abaqus input file to a scene: mesh, materials, sections, orientations, boundary conditions and loads.
#pragma once

#include <string>
#include <vector>

#include "lib/mesh/io/mesh_file.h"

namespace orthodyn {

struct AbaqusScene {
  std::string text;                   // YAML
  std::vector<std::string> left_out;  // keywords not converted, with line numbers; `text` repeats it in comments
};

// Whether the scene is static, and the units of the file.
struct AbaqusSceneOptions {
  bool is_static = false;
  FileUnits units = FileUnits::si;
};

// Converts the Abaqus file at `path`; the scene refers to this file as `file`. If all its materials can be used, the
// scene has no sections `materials` and `regions`; a run then reads both from the mesh file. Otherwise the scene lists
// the materials that can be converted, and comments name the others with the reason. A static scene gets `time` (the
// end of the first step) if an *AMPLITUDE became a factor. Throws ConfigError as read_abaqus() does.
AbaqusScene scene_of_abaqus(const std::string& path, const std::string& file, const AbaqusSceneOptions& options = {});

}  // namespace orthodyn
