// A scene to start from, with what an Abaqus input file has: mesh, materials, sections and orientations.
//
// Source of the order of constants: Abaqus keywords reference, *ELASTIC.
#pragma once

#include <string>

namespace orthodyn {

// The YAML text. Of *ELASTIC it has ISOTROPIC, ENGINEERING CONSTANTS, ORTHOTROPIC and ANISOTROPIC, in the deck's own
// units; comments name the materials that are not read and why, the surfaces and node sets, and the keywords that are
// left out. `path` is read, `file` is what the scene calls it. Throws ConfigError as read_abaqus() does.
std::string scene_of_abaqus(const std::string& path, const std::string& file);

}  // namespace orthodyn
