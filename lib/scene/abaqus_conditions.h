// Boundary conditions and loads of an Abaqus input file as entries of a scene.
//
// Source: Abaqus keywords reference, *BOUNDARY, *CLOAD, *DLOAD, *DSLOAD, *STEP.
#pragma once

#include <string>
#include <vector>

#include "lib/mesh/file_units.h"
#include "lib/mesh/io/abaqus_file.h"

namespace orthodyn {

// Lines of YAML: a value, or the entries of the list of that name.
struct SceneConditions {
  std::string gravity = {};
  std::vector<std::string> clamps = {}, motions = {}, loads = {}, terms = {};
  bool is_linear = false;                  // a step without NLGEOM
  std::vector<std::string> left_out = {};  // "*CLOAD (line 12): ..."
};

// Those of the model and of its first step. `loaded` is the same file's mesh, in SI units; `factor` is the YAML of the
// factor in time of prescribed displacements.
SceneConditions conditions_of(const AbaqusFile& deck, const LoadedMesh& loaded, FileUnits units,
                              const std::string& factor);

// A name as YAML, in quotes where it needs them.
std::string yaml_name(const std::string& name);

}  // namespace orthodyn
