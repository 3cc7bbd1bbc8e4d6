// The part of a mesh that one of several ranks computes: its cells, and their nodes. Each cell is of one rank; a node
// that cells of several ranks have is owned by one of these, and the others have copies of it.
//
// Nodes are numbered anew: those that this rank owns come first, then the copies, each ascending by their numbers in
// the mesh. What belongs to single nodes (masses, springs, contact) is its owner's business; what comes from cells and
// their faces is a sum over ranks.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/ranks.h"
#include "lib/fem/dof_map.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

class Subdomain {
 public:
  // Pairs of nodes in `links` have something in common beside their cells: the owner of the first one has both. Every
  // rank has the whole mesh, and calls this. `ranks` must outlive it.
  Subdomain(const TetMesh& mesh, const std::vector<std::pair<int, int>>& links, const Ranks& ranks);

  const Ranks& ranks() const { return ranks_; }

  // Its cells by their numbers in the mesh, ascending; and its nodes, in their order here.
  const std::vector<int>& cells() const { return cells_; }
  const std::vector<int>& nodes() const { return nodes_; }
  int num_nodes() const { return static_cast<int>(nodes_.size()); }
  int num_owned() const { return num_owned_; }

  // Of a node of the mesh its number here; -1 if this rank has nothing of it.
  int local(int node) const { return local_[static_cast<std::size_t>(node)]; }
  bool owns(int node) const { return local(node) >= 0 && local(node) < num_owned_; }

  // Cells, nodes and regions of this rank; neither surfaces nor node sets.
  TetMesh part_of(const TetMesh& mesh) const;

  // Of numbers for the three coordinates of all nodes those of this rank's.
  template <class T>
  std::vector<T> coordinates_here(const std::vector<T>& of_all) const {
    std::vector<T> out;
    out.reserve(3 * nodes_.size());
    for (const int node : nodes_)
      for (int c = 0; c < 3; ++c) out.push_back(of_all[static_cast<std::size_t>(3 * node + c)]);
    return out;
  }

  // Of nodes of the mesh those that are here, or that are owned here, by their numbers here.
  std::vector<int> here(const std::vector<int>& nodes) const;
  std::vector<int> owned(const std::vector<int>& nodes) const;
  // Of (node, value) those that are owned here.
  template <class T>
  std::vector<std::pair<int, T>> owned(const std::vector<std::pair<int, T>>& values) const {
    std::vector<std::pair<int, T>> out;
    for (const auto& [node, value] : values)
      if (owns(node)) out.emplace_back(local(node), value);
    return out;
  }
  // Whether a face with these corners is one of a cell of this rank, and of none of a rank before it.
  bool has_face(std::span<const int> corners) const;

  // Of vectors with a column per node here: the owners' columns to the copies, and sums of all columns of one node to
  // its owner's, after which those of the copies are zero. Collective.
  void copy_from_owners(NodalVector& values) const { exchange_->copy_from_owners(values.data()); }
  void add_to_owners(NodalVector& values) const { exchange_->add_to_owners(values.data()); }
  // The same of numbers.
  void add_to_owners(Vector& values) const;

  // Throws RecoverableError on all ranks if `trouble` is not empty on some. Collective.
  void agree(const std::string& trouble) const;

 private:
  void find_nodes(const TetMesh& mesh, const std::vector<int>& rank_of_cell,
                  const std::vector<std::pair<int, int>>& links);

  const Ranks& ranks_;
  std::vector<int> cells_, nodes_, local_;
  int num_owned_ = 0;
  std::vector<Triangle> faces_;  // of its cells, by their corners in ascending order; without those of ranks before
  std::unique_ptr<NodeExchange> exchange_;
};

}  // namespace orthodyn
