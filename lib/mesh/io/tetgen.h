// Reads and writes TetGen meshes: .node, .ele and optionally .face files.
//
// Format: Hang Si, TetGen 1.5 user's manual, "file formats".
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// `path` is the .node or .ele file; the other files are in the same folder. Elements form the region
// "region<attribute>", or "body" without attributes. Triangles with marker k != 0 form the surface "marker<k>", nodes
// the node set "marker<k>". Numbers start at 0 or 1. Throws ConfigError "file:line: found, remedy", as read_gmsh()
// does.
LoadedMesh read_tetgen(const std::string& path, FileCells cells = FileCells::keep);

struct TetgenTexts {
  std::string_view node, ele, face;  // `face` may be empty
};

// Reads from texts; `stem`, the path without ending, is for messages.
LoadedMesh read_tetgen_text(const std::string& stem, const TetgenTexts& texts);

// Writes names of the form "region<k>" and "marker<k>" as their number k; other names are replaced by free ones of this
// form.
WrittenMesh write_tetgen(const LoadedMesh& loaded);

}  // namespace orthodyn
