// Partition of a mesh among ranks: adjacency of cells, ranks that share a node, and the amount of communication.
#pragma once

#include <vector>

#include "lib/core/ranks.h"
#include "lib/mesh/mesh_faces.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

// Graph of cells, connected if they share a face. `faces`: sorted_faces() of all `cells`.
CellGraph cell_graph(const std::vector<MeshFace>& faces, std::size_t cells);

// For each node, the ranks of its cells, ascending.
class NodeRanks {
 public:
  // `rank_of_cell` must outlive the object.
  NodeRanks(const Cells& cells, const std::vector<int>& rank_of_cell, std::size_t nodes);

  // The ranks of one node. Valid until the next call.
  const std::vector<int>& of(std::size_t node);

 private:
  const std::vector<int>& rank_of_cell_;
  std::vector<std::size_t> start_;
  std::vector<int> cells_, ranks_;
};

// The rank that owns a node, among the `ranks` that share it: interfaces are divided evenly.
inline int owner_of(std::size_t node, const std::vector<int>& ranks) { return ranks[node % ranks.size()]; }

// Sizes of a part.
struct PartSize {
  long cells = 0;
  long owned = 0;      // nodes that the part owns
  long copies = 0;     // nodes owned by other parts
  long copied = 0;     // copies of owned nodes in other parts
  int neighbours = 0;  // parts it communicates with
};

// Precondition: 0 <= rank_of_cell[cell] < parts.
std::vector<PartSize> part_sizes(const Mesh& mesh, const std::vector<int>& rank_of_cell, int parts);

}  // namespace orthodyn
