// A mesh in parts, one for each rank: which cells are neighbours, which nodes several parts have, and what they then
// have to tell each other.
#pragma once

#include <vector>

#include "lib/core/ranks.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/tet_faces.h"

namespace orthodyn {

// Cells that share a face are neighbours. Precondition: `faces` are those of all `cells`, sorted.
CellGraph cell_graph(const std::vector<TetFace>& faces, std::size_t cells);

// For each node the ranks of its cells, ascending.
class RanksOfNodes {
 public:
  // `rank_of_cell` must outlive this.
  RanksOfNodes(const Cells& cells, const std::vector<int>& rank_of_cell, std::size_t nodes);

  // Valid until the next call.
  const std::vector<int>& of(std::size_t node);

 private:
  const std::vector<int>& rank_of_cell_;
  std::vector<std::size_t> start_;
  std::vector<int> cells_, ranks_;
};

// Which of the ranks that have a node owns it: borders are shared evenly.
inline int owner_of(std::size_t node, const std::vector<int>& having) { return having[node % having.size()]; }

struct PartFigures {
  long cells = 0;
  long owned = 0;      // nodes
  long copies = 0;     // of other parts' nodes
  long copied = 0;     // copies that other parts have of its own
  int neighbours = 0;  // parts that it exchanges numbers with
};

// Precondition: `rank_of_cell` has a number below `parts` for each cell.
std::vector<PartFigures> figures_of_parts(const TetMesh& mesh, const std::vector<int>& rank_of_cell, int parts);

}  // namespace orthodyn
