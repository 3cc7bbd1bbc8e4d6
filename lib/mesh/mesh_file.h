// Mesh files of every format, chosen by the ending of their name.
#pragma once

#include <string>
#include <vector>

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

struct MeshFormat {
  std::string name;                  // "Gmsh"
  std::vector<std::string> endings;  // ".msh"
  LoadedMesh (*read)(const std::string& path);
  bool materials;  // the format can hold them
};

const std::vector<MeshFormat>& mesh_formats();

// Throws ConfigError, listing the endings, if no format has this one (capitals do not matter).
const MeshFormat& mesh_format_of(const std::string& path);

// Throws ConfigError.
LoadedMesh read_mesh(const std::string& path);

// Multiplies all coordinates. Throws ConfigError, beginning with `source`, if a volume can then no longer be
// represented.
void scale_mesh(TetMesh& mesh, double factor, const std::string& source);

}  // namespace orthodyn
