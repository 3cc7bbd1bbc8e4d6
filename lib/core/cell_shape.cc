#include "lib/core/cell_shape.h"

#include <algorithm>
#include <cstddef>

namespace orthodyn {

namespace {

using Lists = std::vector<std::vector<int>>;

const Lists kTetEdgeCorners{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
const Lists kTetSides{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
const Lists kWedgeEdgeCorners{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
const Lists kWedgeSides{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
const Lists kHexEdgeCorners{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                            {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
const Lists kHexSides{{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

const Lists kTriangleSides{{0, 1}, {1, 2}, {2, 0}}, kQuadSides{{0, 1}, {1, 2}, {2, 3}, {3, 0}};

// Whether two lists have the same members.
bool same(std::vector<int> a, std::vector<int> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

// `sides`: the corners of the faces. Appends the middles of their edges and of the faces themselves.
CellTopology make(const char* name, const char* plural, int vtk_type, int corners, const Lists& middles,
                  const Lists& sides) {
  CellTopology out{
      name,    plural, vtk_type, corners, corners + static_cast<int>(middles.size()), middles.empty() ? 1 : 2,
      middles, sides};
  const auto append_middle = [&](std::vector<int>& face, const std::vector<int>& of) {
    for (std::size_t m = 0; m < middles.size(); ++m)
      if (same(middles[m], of)) face.push_back(corners + static_cast<int>(m));
  };
  for (std::size_t f = 0; f < sides.size(); ++f) {
    const std::vector<int>& side = sides[f];
    for (std::size_t k = 0; k < side.size(); ++k) append_middle(out.faces[f], {side[k], side[(k + 1) % side.size()]});
    if (side.size() == 4) append_middle(out.faces[f], side);
  }
  return out;
}

// The middles of edges, of the quadrilaterals among the faces, and of the cell if it has eight corners.
Lists with_centres(Lists middles, const Lists& sides) {
  for (const std::vector<int>& side : sides)
    if (side.size() == 4) middles.push_back(side);
  if (sides.size() == 6) middles.push_back({0, 1, 2, 3, 4, 5, 6, 7});
  return middles;
}

}  // namespace

int CellTopology::corners_of_face(std::size_t face) const {
  return static_cast<int>(order == 1 ? faces[face].size() : faces[face].size() / 2);
}

const CellTopology& topology(CellShape shape) {
  static const CellTopology tet4 = make("tetrahedron", "tetrahedra", 10, 4, {}, kTetSides);
  static const CellTopology tet10 =
      make("quadratic tetrahedron", "quadratic tetrahedra", 24, 4, kTetEdgeCorners, kTetSides);
  static const CellTopology wedge6 = make("wedge of 6 nodes", "wedges of 6 nodes", 13, 6, {}, kWedgeSides);
  static const CellTopology wedge15 =
      make("wedge of 15 nodes", "wedges of 15 nodes", 26, 6, kWedgeEdgeCorners, kWedgeSides);
  static const CellTopology wedge18 =
      make("wedge of 18 nodes", "wedges of 18 nodes", 32, 6, with_centres(kWedgeEdgeCorners, kWedgeSides), kWedgeSides);
  static const CellTopology hex8 = make("hexahedron of 8 nodes", "hexahedra of 8 nodes", 12, 8, {}, kHexSides);
  static const CellTopology hex20 =
      make("hexahedron of 20 nodes", "hexahedra of 20 nodes", 25, 8, kHexEdgeCorners, kHexSides);
  static const CellTopology hex27 = make("hexahedron of 27 nodes", "hexahedra of 27 nodes", 29, 8,
                                         with_centres(kHexEdgeCorners, kHexSides), kHexSides);
  static const CellTopology tri3 = make("triangle", "triangles", 5, 3, {}, {});
  static const CellTopology tri6 = make("quadratic triangle", "quadratic triangles", 22, 3, kTriangleSides, {});
  static const CellTopology quad4 = make("quadrilateral", "quadrilaterals", 9, 4, {}, {});
  static const CellTopology quad8 =
      make("quadrilateral of 8 nodes", "quadrilaterals of 8 nodes", 23, 4, kQuadSides, {});
  static const CellTopology quad9 = make("quadrilateral of 9 nodes", "quadrilaterals of 9 nodes", 28, 4,
                                         {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}}, {});
  switch (shape) {
    case CellShape::tet4: return tet4;
    case CellShape::tet10: return tet10;
    case CellShape::wedge6: return wedge6;
    case CellShape::wedge15: return wedge15;
    case CellShape::wedge18: return wedge18;
    case CellShape::hex8: return hex8;
    case CellShape::hex20: return hex20;
    case CellShape::hex27: return hex27;
    case CellShape::tri3: return tri3;
    case CellShape::tri6: return tri6;
    case CellShape::quad4: return quad4;
    case CellShape::quad8: return quad8;
    case CellShape::quad9: return quad9;
  }
  return tet4;
}

}  // namespace orthodyn
