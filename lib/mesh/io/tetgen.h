// TetGen's meshes: .node and .ele, and .face if there are surfaces.
//
// Format: Hang Si, TetGen 1.5 user's manual, "file formats".
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// `path` names the .node or the .ele file; the others are beside it. Elements belong to the region
// "region<attribute>", or "body" without attributes. Triangles of the .face file with a marker other
// than zero make surfaces "marker<k>", nodes likewise node sets "marker<k>". Numbers count from 0 or
// 1. Throws ConfigError "file:line: found, remedy", as read_gmsh() does.
LoadedMesh read_tetgen(const std::string& path);

struct TetgenTexts {
  std::string_view node, ele, face;  // the last may be empty
};

// The same from texts; `stem` is the path without its ending, for messages.
LoadedMesh read_tetgen_text(const std::string& stem, const TetgenTexts& texts);

// Names are lost but for "region<k>" and "marker<k>".
WrittenMesh write_tetgen(const LoadedMesh& loaded);

}  // namespace orthodyn
