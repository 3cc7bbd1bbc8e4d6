#include "lib/mesh/partition.h"

#include <algorithm>
#include <numeric>

namespace orthodyn {

namespace {

std::size_t as_index(int i) { return static_cast<std::size_t>(i); }

}  // namespace

CellGraph cell_graph(const std::vector<MeshFace>& faces, std::size_t cells) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t begin = 0; begin < faces.size(); begin = end_of_face(faces, begin))
    if (end_of_face(faces, begin) == begin + 2) {
      pairs.emplace_back(faces[begin].cell, faces[begin + 1].cell);
      pairs.emplace_back(faces[begin + 1].cell, faces[begin].cell);
    }
  std::sort(pairs.begin(), pairs.end());
  CellGraph graph{std::vector<int>(cells + 1, 0), {}};
  for (const auto& [cell, neighbour] : pairs) {
    ++graph.start[as_index(cell) + 1];
    graph.neighbours.push_back(neighbour);
  }
  std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
  return graph;
}

NodeRanks::NodeRanks(const Cells& cells, const std::vector<int>& rank_of_cell, std::size_t nodes)
    : rank_of_cell_(rank_of_cell), start_(nodes + 1, 0), cells_(cells.nodes().size()) {
  for (const int node : cells.nodes()) ++start_[as_index(node) + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    for (const int node : cells[cell]) cells_[next[as_index(node)]++] = static_cast<int>(cell);
}

const std::vector<int>& NodeRanks::of(std::size_t node) {
  ranks_.clear();
  for (std::size_t k = start_[node]; k < start_[node + 1]; ++k) ranks_.push_back(rank_of_cell_[as_index(cells_[k])]);
  std::sort(ranks_.begin(), ranks_.end());
  ranks_.erase(std::unique(ranks_.begin(), ranks_.end()), ranks_.end());
  return ranks_;
}

std::vector<PartSize> part_sizes(const Mesh& mesh, const std::vector<int>& rank_of_cell, int parts) {
  std::vector<PartSize> sizes(as_index(parts));
  for (const int rank : rank_of_cell) ++sizes[as_index(rank)].cells;
  std::vector<std::pair<int, int>> exchanges;  // pairs of parts that share a node
  NodeRanks ranks_of(mesh.cells, rank_of_cell, mesh.nodes.size());
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const std::vector<int>& ranks = ranks_of.of(node);
    const int owner = owner_of(node, ranks);
    ++sizes[as_index(owner)].owned;
    sizes[as_index(owner)].copied += static_cast<long>(ranks.size()) - 1;
    for (const int rank : ranks)
      if (rank != owner) {
        ++sizes[as_index(rank)].copies;
        exchanges.emplace_back(std::min(owner, rank), std::max(owner, rank));
      }
  }
  std::sort(exchanges.begin(), exchanges.end());
  exchanges.erase(std::unique(exchanges.begin(), exchanges.end()), exchanges.end());
  for (const auto& [a, b] : exchanges) ++sizes[as_index(a)].neighbours, ++sizes[as_index(b)].neighbours;
  return sizes;
}

}  // namespace orthodyn
