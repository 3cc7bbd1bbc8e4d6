// Reads and writes Gmsh .msh files: formats 2.0 to 2.2 and 4.1, ASCII or binary (2.2 and 4.1).
//
// Format: Geuzaine and Remacle, Gmsh reference manual, "MSH file format" and "MSH file format
// version 2 (Legacy)".
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// Physical volumes become regions, physical surfaces become surfaces, physical curves and points become node sets.
// Physical groups keep their names; unnamed ones are called "volume<tag>", "surface<tag>", "curve<tag>" and
// "points<tag>". Elements in no physical volume form the region "body". Nodes are numbered by ascending tag, regions by
// ascending physical tag, elements in file order; so both formats of a mesh give the same result. Coordinates are in
// metres.
//
// Throws ConfigError "file:line: found, remedy" unless the file is a complete, valid mesh of linear or quadratic solid
// elements (see build_mesh() and validate()). Memory use is bounded by the file size, whatever counts the file
// announces.
LoadedMesh read_gmsh(const std::string& path, FileCells cells = FileCells::keep);

// Reads from a text or from bytes; messages for a binary file refer to lines of its ASCII form. `path` is for messages.
LoadedMesh read_gmsh_text(const std::string& path, std::string_view text, FileCells cells = FileCells::keep);

// Write regions, surfaces and node sets as physical volumes, surfaces and points.
WrittenMesh write_gmsh22(const LoadedMesh& loaded);
WrittenMesh write_gmsh41(const LoadedMesh& loaded);

}  // namespace orthodyn
