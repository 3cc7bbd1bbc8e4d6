// The kinds of solid elements that mesh files hold, and their corners:
//
//   tet         0 1 2 the base, 3 on the side to which its normal points
//   pyramid     0 1 2 3 around the base, 4 on the side to which its normal points
//   wedge       0 1 2 the base, its normal to the inside, 3 4 5 above them
//   hexahedron  0 1 2 3 around the base, its normal to the inside, 4 5 6 7 above them
//
// as Gmsh and Abaqus number them.
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

// "hexahedron", or "hexahedra" of several.
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
