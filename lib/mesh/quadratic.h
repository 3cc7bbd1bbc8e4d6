// Quadratic meshes: the nodes on edges.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "lib/core/cells.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

// The node on each edge of a quadratic mesh.
class EdgeNodes {
 public:
  explicit EdgeNodes(const TetMesh& mesh);
  // Of the edges between corners of these faces only.
  EdgeNodes(const TetMesh& mesh, const std::vector<Triangle>& faces);
  // Precondition: this edge is among them.
  int at(int a, int b) const;

 private:
  std::unordered_map<std::uint64_t, int> nodes_;
};

// Where the node between two nodes belongs, m.
using MiddlePlace = std::function<Vec3(int a, int b)>;

// Makes a linear mesh quadratic: a new node for each edge, by default half way, numbered after those that are there.
// Node sets get those between two of their nodes on the surface. Precondition: valid, and linear.
void make_quadratic(TetMesh& mesh, const MiddlePlace& place = {});

// Leaves out the nodes on edges, which come after all corners or between them. Returns the node sets that are empty
// without them.
std::vector<std::string> make_linear(TetMesh& mesh);

// The cells with all their nodes: of 4, or of 10 as in VTK_QUADRATIC_TETRA.
Cells tet_cells(const TetMesh& mesh);

// Faces, given by their corners, with all their nodes: of 3, or of 6 as in VTK_QUADRATIC_TRIANGLE.
Cells face_cells(const TetMesh& mesh, const std::vector<Triangle>& triangles);

}  // namespace orthodyn
