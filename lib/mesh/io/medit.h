// Reads Medit meshes in text form (.mesh).
//
// Format: P. Frey, "Medit: an interactive mesh visualization software" (INRIA RT-0253, 2001), and libMeshb's keywords.
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// Tetrahedra, TetrahedraP2, Hexahedra, Prisms and Pyramids with reference k form "region<k>". Triangles, TrianglesP2
// and Quadrilaterals with reference k != 0 form the surface "surface<k>", vertices the node set "vertices<k>". Other
// solid elements and the binary form (.meshb) are errors; other sections are skipped with a warning. Throws ConfigError
// "file:line: found, remedy", as read_gmsh() does.
LoadedMesh read_medit(const std::string& path, FileCells cells = FileCells::keep);

// Reads from a text; `path` is for messages.
LoadedMesh read_medit_text(const std::string& path, std::string_view text, FileCells cells = FileCells::keep);

}  // namespace orthodyn
