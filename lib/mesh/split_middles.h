// Mid-edge nodes of the tetrahedra that quadratic elements are split into. On the edges of the elements these are nodes
// of the file. On a diagonal of a face or hexahedron that has no node of the file, a new node is created at the centre,
// placed by the serendipity shape functions of the face or hexahedron. On any other edge the new node is at the
// midpoint.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lib/mesh/cell_kind.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

// Mid-edge nodes of a tet, in the order of kTetEdges.
using Midsides = std::array<int, 6>;

// The mid-edge node between the corners a and b.
struct EdgeMiddle {
  int a, b, middle;
};

class SplitMiddles {
 public:
  // Appends new nodes to the mesh, which must outlive the object.
  explicit SplitMiddles(Mesh& mesh) : mesh_(mesh) {}

  // Both must be called for all elements, tets included, before of(): first add_edges(), then add_diagonals().
  void add_edges(std::span<const EdgeMiddle> edges);
  void add_diagonals(CellKind kind, std::span<const int> corners);

  // The mid-edge nodes of a tet.
  Midsides of(const Tet& tet);

  // Adds the new node of a face to node sets that contain all other nodes of the face.
  void complete_node_sets();

 private:
  struct Diagonal {
    std::vector<int> corners, middles;  // of the face, or of the hexahedron
    bool is_face;
  };

  int middle(int a, int b);
  void add_diagonal(int a, int b, const Diagonal& diagonal);

  Mesh& mesh_;
  std::unordered_map<std::uint64_t, int> middles_;  // by edge
  std::unordered_map<std::uint64_t, Diagonal> diagonals_;
  std::vector<std::pair<int, Diagonal>> new_on_faces_;
};

}  // namespace orthodyn
