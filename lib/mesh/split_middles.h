// The nodes on the edges of tetrahedra that elements of second order are split into: those of the file on the elements'
// own edges, and new ones on the diagonals of their faces and within hexahedra, where the serendipity shape functions
// of the element have the middle.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lib/mesh/cell_kind.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

// The node in the middle of the edge between the corners a and b.
struct EdgeMiddle {
  int a, b, middle;
};

class SplitMiddles {
 public:
  // New nodes are appended to the mesh, which must outlive this.
  explicit SplitMiddles(TetMesh& mesh) : mesh_(mesh) {}

  // First all elements are made known (a tetrahedron, too), then their tets can be asked for.
  void add_edges(std::span<const EdgeMiddle> edges);
  void add_diagonals(CellKind kind, std::span<const int> corners);

  Midsides of(const Tet& tet);

  // Node sets that have a face get the new node on it.
  void complete_node_sets();

 private:
  struct Diagonal {
    std::vector<int> corners, middles;  // of the face, or of the hexahedron
    bool is_face;
  };

  int middle(int a, int b);
  void add_diagonal(int a, int b, const Diagonal& diagonal);

  TetMesh& mesh_;
  std::unordered_map<std::uint64_t, int> middles_;  // by edge
  std::unordered_map<std::uint64_t, Diagonal> diagonals_;
  std::vector<std::pair<int, Diagonal>> new_on_faces_;
};

}  // namespace orthodyn
