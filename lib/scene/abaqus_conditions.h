// Boundary conditions and loads of an Abaqus input file as entries of a scene.
//
// Source: Abaqus keywords reference, *BOUNDARY, *CLOAD, *DLOAD, *DSLOAD, *STEP, *AMPLITUDE, *TRANSFORM.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_file.h"
#include "lib/scene/abaqus_scene.h"

namespace orthodyn {

// Lines of YAML: a value, or the entries of the list of that name.
struct SceneConditions {
  std::string gravity = {};
  std::vector<std::string> clamps = {}, motions = {}, loads = {}, terms = {};
  bool is_linear = false;                  // a step without NLGEOM
  std::optional<double> end = {};          // of the first step, s, where factors are tables over its time
  std::vector<std::string> left_out = {};  // "*CLOAD (line 12): ..."
};

// Those of the model and of its first step. `loaded` is the same file's mesh, in SI units.
SceneConditions conditions_of(const AbaqusFile& deck, const LoadedMesh& loaded, const AbaqusSceneOptions& options);

// A name as YAML, in quotes where it needs them.
std::string yaml_name(const std::string& name);

}  // namespace orthodyn
