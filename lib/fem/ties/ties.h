// Tied nodes: they have no unknowns, and follow other nodes, their leaders: u_s = sum_i w_i u_i.
// Ties are multipoint constraints. Where two surfaces are tied, the tied nodes belong to the slave (non-mortar) side,
// and the leaders to the master (mortar) side.
//
// With u = T q for the displacements u of all nodes and the unknowns q, the forces on the unknowns are T^T f, and the
// matrices T^T K T. They stay symmetric and definite, so that nothing else in the program has to know ties.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lib/core/cells.h"
#include "lib/fem/nodal_vector.h"

namespace orthodyn {

struct TiedNode {
  int node;
  std::vector<std::pair<int, double>> leaders;  // nodes and weights; the sum of the weights is 1
  double sum_of_magnitudes() const;             // of the weights, >= 1
};

class Ties {
 public:
  Ties() = default;
  // Leaders may be tied to others; they are replaced by their own leaders. Throws ConfigError if nodes follow each
  // other in a circle. Precondition: each node is tied once.
  Ties(int num_nodes, std::vector<TiedNode> nodes);

  bool empty() const { return nodes_.empty(); }
  const std::vector<TiedNode>& nodes() const { return nodes_; }
  bool is_tied(int node) const { return !empty() && index_[static_cast<std::size_t>(node)] >= 0; }

  // Calls visit(leader, weight) for the leaders of a tied node, and visit(node, 1) for another node.
  template <class Visit>
  void for_each_leader(int node, Visit&& visit) const {
    if (!is_tied(node)) return visit(node, 1.0);
    for (const auto& [leader, weight] : tied(node).leaders) visit(leader, weight);
  }

  // Sets the displacement of each tied node to the weighted sum of the displacements of its leaders.
  void place(NodalVector& u) const;
  // Moves the forces on tied nodes to their leaders.
  void gather(NodalVector& forces) const;
  // Moves values b of tied nodes to their leaders so that sum b_i u_i^2 does not decrease for any motion of the
  // leaders.
  void move_bounds(Vector& b) const;

  // The pairs of nodes that have a common matrix entry because of ties: the leaders of all nodes of a cell, and of both
  // nodes of each pair in `further`.
  std::vector<std::pair<int, int>> couplings(const Cells& cells, const std::vector<std::pair<int, int>>& further) const;

 private:
  const TiedNode& tied(int node) const {
    return nodes_[static_cast<std::size_t>(index_[static_cast<std::size_t>(node)])];
  }

  std::vector<TiedNode> nodes_;
  std::vector<int> index_;  // in nodes_, for each node of the mesh; -1 if it is not tied
};

}  // namespace orthodyn
