// The part of a mesh that one rank computes: its cells and their nodes. Each cell belongs to one rank. A node of cells
// of several ranks is owned by one of these ranks; the others have copies.
//
// Local numbering: owned nodes first, then copies, each in ascending order of their mesh indices. Contributions of
// single nodes (masses, springs, contact at nodes) are computed by the owner; contributions of cells and faces are
// summed over ranks.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/errors.h"
#include "lib/core/ranks.h"
#include "lib/fem/dof_map.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

class Subdomain {
 public:
  // For each node pair in `links`, the owner of the first node also gets the second. Collective: every rank passes the
  // whole mesh. `ranks` must outlive this object.
  Subdomain(const Mesh& mesh, const std::vector<std::pair<int, int>>& links, const Ranks& ranks);

  const Ranks& ranks() const { return ranks_; }

  // Mesh indices of the cells (ascending) and of the nodes (in local order).
  const std::vector<int>& cells() const { return cells_; }
  const std::vector<int>& nodes() const { return nodes_; }
  int num_nodes() const { return static_cast<int>(nodes_.size()); }
  int num_owned() const { return num_owned_; }

  // Local index of a mesh node; -1 if the node is not on this rank.
  int local(int node) const { return local_[static_cast<std::size_t>(node)]; }
  bool owns(int node) const { return local(node) >= 0 && local(node) < num_owned_; }

  // The local mesh: cells, nodes and regions, without surfaces and node sets.
  Mesh part_of(const Mesh& mesh) const;

  // Restricts values per coordinate (3 * node + component) of the mesh to the local nodes.
  template <class T>
  std::vector<T> coordinates_here(const std::vector<T>& of_all) const {
    std::vector<T> out;
    out.reserve(3 * nodes_.size());
    for (const int node : nodes_)
      for (int c = 0; c < 3; ++c) out.push_back(of_all[static_cast<std::size_t>(3 * node + c)]);
    return out;
  }

  // Local indices of those of the given mesh nodes that exist on this rank, or that this rank owns.
  std::vector<int> here(const std::vector<int>& nodes) const;
  std::vector<int> owned(const std::vector<int>& nodes) const;
  // Likewise for pairs (node, value): keeps those whose node this rank owns.
  template <class T>
  std::vector<std::pair<int, T>> owned(const std::vector<std::pair<int, T>>& values) const {
    std::vector<std::pair<int, T>> out;
    for (const auto& [node, value] : values)
      if (owns(node)) out.emplace_back(local(node), value);
    return out;
  }
  // Whether a face belongs to this rank. A face belongs to the lowest rank with a cell at the
  // face.
  bool has_face(FaceCorners face) const;

  // Vectors with one column per local node. copy_from_owners() sets the columns of copies to those of the owners;
  // add_to_owners() adds the columns of all copies to those of the owners and sets the copies to zero. Collective.
  void copy_from_owners(NodalVector& values) const { exchange_->copy_from_owners(values.data()); }
  void add_to_owners(NodalVector& values) const { exchange_->add_to_owners(values.data()); }
  void add_to_owners(Vector& values) const;  // one number per local node

  // Field at all mesh nodes, from the owners' values: `components` numbers per node. Collective.
  std::vector<double> whole_field(const std::vector<double>& here, std::size_t components) const;

  // Throws RecoverableError on all ranks if `trouble` is not empty on any rank. Collective.
  void agree(const std::string& trouble) const;

 private:
  void find_nodes(const Mesh& mesh, const std::vector<int>& rank_of_cell,
                  const std::vector<std::pair<int, int>>& links);

  const Ranks& ranks_;
  std::vector<int> cells_, nodes_, local_;
  int num_owned_ = 0;
  std::vector<FaceCorners> faces_;  // faces of this rank, sorted
  std::unique_ptr<NodeExchange> exchange_;
};

// Runs compute(). A RecoverableError on some ranks is thrown on all ranks. `subdomain` is null with one rank.
// Collective.
template <class Compute>
void on_all_ranks(const Subdomain* subdomain, Compute&& compute) {
  if (!subdomain) return compute();
  std::string trouble;
  try {
    compute();
  } catch (const RecoverableError& e) {
    trouble = e.what();
  }
  subdomain->agree(trouble);
}

}  // namespace orthodyn
