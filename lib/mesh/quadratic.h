// Quadratic meshes: mid-edge nodes.
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
  // Contains only the edges between corners of these faces.
  EdgeNodes(const TetMesh& mesh, const std::vector<Triangle>& faces);
  // Precondition: the edge is in the map.
  int at(int a, int b) const;

 private:
  std::unordered_map<std::uint64_t, int> nodes_;
};

// Key of the edge between two nodes, in either order.
std::uint64_t edge_key(int a, int b);

// Position (m) of the mid-edge node between two nodes.
using MiddlePlace = std::function<Vec3(int a, int b)>;

// Makes a linear mesh quadratic: adds a node per edge, by default at its midpoint, numbered after the existing nodes.
// Adds new nodes to node sets if both ends of a surface edge are in the set. Precondition: a valid linear mesh.
void make_quadratic(TetMesh& mesh, const MiddlePlace& place = {});

// The checks of validate() for quadratic meshes: folded elements, inconsistent mid-edge nodes. Throws ConfigError.
void validate_quadratic(const TetMesh& mesh, const MeshOrigin& origin);

// Removes the mid-edge nodes. Returns the names of node sets that become empty.
std::vector<std::string> make_linear(TetMesh& mesh);

// Cells with all nodes: 4, or 10 as in VTK_QUADRATIC_TETRA.
Cells tet_cells(const TetMesh& mesh);

// Faces, given by their corners, with all nodes: 3, or 6 as in VTK_QUADRATIC_TRIANGLE.
Cells face_cells(const TetMesh& mesh, const std::vector<Triangle>& triangles);

}  // namespace orthodyn
