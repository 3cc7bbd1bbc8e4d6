// Kinds of solid elements in mesh files. Corners are numbered as by Gmsh and Abaqus; the normal of the base points
// inward:
//
//   tet         base 0 1 2, apex 3
//   pyramid     base 0 1 2 3, apex 4
//   wedge       base 0 1 2, opposite face 3 4 5
//   hexahedron  base 0 1 2 3, opposite face 4 5 6 7
#pragma once

#include <cstddef>

namespace orthodyn {

enum class CellKind { tet, pyramid, wedge, hexahedron };

constexpr std::size_t corners_of(CellKind kind) {
  switch (kind) {
    case CellKind::tet: return 4;
    case CellKind::pyramid: return 5;
    case CellKind::wedge: return 6;
    case CellKind::hexahedron: return 8;
  }
  return 0;
}

// "hexahedron", or "hexahedra" unless count == 1.
constexpr const char* name_of(CellKind kind, std::size_t count = 1) {
  switch (kind) {
    case CellKind::tet: return count == 1 ? "tetrahedron" : "tetrahedra";
    case CellKind::pyramid: return count == 1 ? "pyramid" : "pyramids";
    case CellKind::wedge: return count == 1 ? "wedge" : "wedges";
    case CellKind::hexahedron: return count == 1 ? "hexahedron" : "hexahedra";
  }
  return "";
}

}  // namespace orthodyn
