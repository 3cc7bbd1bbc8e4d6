// Reads tetrahedral meshes from Gmsh .msh files, formats 2.2 and 4.1, ASCII.
//
// Format: Geuzaine and Remacle, Gmsh reference manual, "MSH file format" and "MSH file format
// version 2 (Legacy)".
#pragma once

#include <string>

#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

struct LoadedMesh {
  TetMesh mesh;
  Warnings warnings;
};

// Physical volumes become regions and physical surfaces become surfaces, under their names or else
// as "volume<tag>" and "surface<tag>". Tets in no physical volume form the region "body". Nodes are
// numbered by ascending tag, regions by ascending physical tag, elements in the order of the file,
// so that both formats of one mesh give the same. Coordinates are taken as metres.
//
// Throws ConfigError "file:line: found, remedy" for anything that is not a complete and valid mesh
// of linear tets (see validate()). Memory use is bounded by the size of the file, whatever counts
// it announces.
LoadedMesh read_gmsh(const std::string& path);

}  // namespace orthodyn
