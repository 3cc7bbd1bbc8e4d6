// Meshes of solid elements in Gmsh's .msh files, formats 2.0 to 2.2 and 4.1, ASCII or binary (2.2 and 4.1).
//
// Format: Geuzaine and Remacle, Gmsh reference manual, "MSH file format" and "MSH file format
// version 2 (Legacy)".
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// Physical volumes become regions, physical surfaces become surfaces and physical points become node
// sets, under their names or else as "volume<tag>", "surface<tag>" and "points<tag>". Elements in no physical
// volume form the region "body". Nodes are numbered by ascending tag, regions by ascending physical tag,
// elements in the order of the file, so that both formats of one mesh give the same. Coordinates are taken
// as metres.
//
// Throws ConfigError "file:line: found, remedy" for anything that is not a complete and valid mesh
// of linear or quadratic tets, or of what is split into tets (see build_mesh() and validate()). Memory use is bounded
// by the size of the file, whatever counts it announces.
LoadedMesh read_gmsh(const std::string& path);

// The same from a text, or from bytes, whose messages name the lines of the same file in ASCII; `path` is for messages.
LoadedMesh read_gmsh_text(const std::string& path, std::string_view text);

// Regions, surfaces and node sets as physical volumes, surfaces and points.
WrittenMesh write_gmsh22(const LoadedMesh& loaded);
WrittenMesh write_gmsh41(const LoadedMesh& loaded);

}  // namespace orthodyn
