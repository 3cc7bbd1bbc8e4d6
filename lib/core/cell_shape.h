// Shapes of cells: their corners, mid-nodes ("middles") and faces. Nodes are numbered as by VTK:
//
//   tetrahedron  corners 0 1 2 3, with positive volume (x1-x0) . ((x2-x0) x (x3-x0))
//   wedge        triangle 0 1 2, opposite triangle 3 4 5; the normal of 0 1 2 points inward (in VTK's manual: outward)
//   hexahedron   quadrilateral 0 1 2 3, opposite one 4 5 6 7; the normal of 0 1 2 3 points inward
//
// The nodes after the corners are the middles of edges, then of quadrilaterals, then of the cell.
#pragma once

#include <vector>

namespace orthodyn {

enum class CellShape : unsigned char {
  // Solid cells.
  tet4,
  tet10,
  wedge6,
  wedge15,
  wedge18,
  hex8,
  hex20,
  hex27,
  // Faces.
  tri3,
  tri6,
  quad4,
  quad8,
  quad9,
};

struct CellTopology {
  const char* name;    // "hexahedron of 20 nodes"
  const char* plural;  // "hexahedra of 20 nodes"
  int vtk_type;
  int corners, nodes;
  int order;  // 1: linear, 2: quadratic
  // For each node after the corners: the corners of the edge (2), quadrilateral (4) or cell (8) with this middle.
  std::vector<std::vector<int>> middles;
  // Nodes of each face: corners counterclockwise as seen from outside, then the middle of each edge from a corner to
  // the next one, then the middle of a quadrilateral. Empty for shapes of faces.
  std::vector<std::vector<int>> faces;

  int corners_of_face(std::size_t face) const;
};

const CellTopology& topology(CellShape shape);

}  // namespace orthodyn
