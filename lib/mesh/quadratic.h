// Quadratic meshes: the nodes in the middle of edges, quadrilaterals and cells.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "lib/core/cells.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

// The node in the middle of each edge and of each quadrilateral of a quadratic mesh.
class MiddleNodes {
 public:
  explicit MiddleNodes(const Mesh& mesh);
  // Contains only the edges and quadrilaterals whose corners are corners of these faces.
  MiddleNodes(const Mesh& mesh, const std::vector<FaceCorners>& faces);

  // The middle of an edge between two corners. Precondition: the edge is in the map.
  int of_edge(int a, int b) const;
  // The middle of a quadrilateral; empty if its cells have no node there.
  std::optional<int> of_face(const FaceCorners& face) const;

 private:
  void add(const Mesh& mesh, std::size_t cell);

  std::unordered_map<std::uint64_t, int> edges_, faces_;
};

// Key of the edge between two nodes, in either order.
std::uint64_t edge_key(int a, int b);

// Position (m) of the mid-edge node between two nodes.
using MiddlePlace = std::function<Vec3(int a, int b)>;

// Makes a linear mesh quadratic: tetrahedra of 10, wedges of 15 and hexahedra of 20 nodes. Adds a node per edge, by
// default at its midpoint, numbered after the existing nodes. Adds new nodes to node sets if both ends of a surface
// edge are in the set. Precondition: a valid linear mesh.
void make_quadratic(Mesh& mesh, const MiddlePlace& place = {});

// Adds the nodes in the middle of quadrilaterals and hexahedra that do not have one, placed by the shape functions of
// the cells: hexahedra of 20 nodes get 27, wedges of 15 get 18. Node sets do not change. Precondition: a quadratic
// mesh.
void add_centres(Mesh& mesh);

// The checks of validate() for the middle nodes of quadratic meshes. Throws ConfigError.
void validate_quadratic(const Mesh& mesh, const MeshOrigin& origin);

// Removes the nodes that are not corners. Returns the names of node sets that become empty.
std::vector<std::string> make_linear(Mesh& mesh);

// Faces, given by their corners, with all nodes.
Cells face_cells(const Mesh& mesh, const std::vector<FaceCorners>& faces);

}  // namespace orthodyn
