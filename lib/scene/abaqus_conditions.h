// Converts boundary conditions and loads of an Abaqus input file to YAML entries of a scene.
//
// Source: Abaqus keywords reference, *BOUNDARY, *CLOAD, *DLOAD, *DSLOAD, *STEP, *AMPLITUDE, *TRANSFORM.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_file.h"
#include "lib/scene/abaqus_scene.h"

namespace orthodyn {

// Converted conditions as lines of YAML: the value of `gravity`, and the entries of the lists.
struct SceneConditions {
  std::string gravity = {};
  std::vector<std::string> clamps = {}, motions = {}, loads = {}, terms = {};
  bool is_linear = false;                  // the first step has no NLGEOM, or NLGEOM=NO
  std::optional<double> end = {};          // end of the first step (s); empty if no amplitude became a table
  std::vector<std::string> left_out = {};  // keywords that were not converted: "*CLOAD (line 12): ..."
};

// Converts the conditions of the model and of its first step. `loaded`: the mesh of the same file, converted to SI
// units.
SceneConditions conditions_of(const AbaqusFile& deck, const LoadedMesh& loaded, const AbaqusSceneOptions& options);

// A name as YAML, quoted if necessary.
std::string yaml_name(const std::string& name);

}  // namespace orthodyn
