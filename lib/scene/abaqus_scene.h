// A scene to start from, with what an Abaqus input file has: mesh, materials, sections, orientations, boundary
// conditions and loads.
#pragma once

#include <string>
#include <vector>

#include "lib/mesh/file_units.h"

namespace orthodyn {

struct AbaqusScene {
  std::string text;                   // YAML
  std::vector<std::string> left_out;  // what the file has beside, with its lines; the text has it as comments
};

// How the scene goes on in time, and in which units the file is.
struct AbaqusSceneOptions {
  bool is_static = false;
  FileUnits units = FileUnits::si;
};

// The scene leaves out `materials` and `regions` where the file's can be used, which the program then does; else it has
// those that can be read, and comments name the others and why. Where an *AMPLITUDE became a factor, a
// static scene has `time`, the end of the first step. `path` is read, `file` is what the scene calls it. Throws
// ConfigError as read_abaqus() does.
AbaqusScene scene_of_abaqus(const std::string& path, const std::string& file, const AbaqusSceneOptions& options = {});

}  // namespace orthodyn
