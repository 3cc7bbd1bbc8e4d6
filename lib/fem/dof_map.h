// Numbers the unknowns: the coordinates of all nodes that are not clamped.
//
// With several ranks, each rank has its own nodes followed by copies of other ranks' nodes (subdomain.h). Unknowns of
// copies are numbered too, for matrices; vectors of unknowns hold only those of the rank's own nodes.
#pragma once

#include <array>
#include <vector>

#include "lib/core/types.h"

namespace orthodyn {

using NodalVector = Eigen::Matrix<double, 3, Eigen::Dynamic>;  // one column per node

class DofMap {
 public:
  // clamped[3 * node + component]: whether this coordinate is clamped.
  DofMap(int num_nodes, const std::vector<bool>& clamped) : DofMap(num_nodes, clamped, num_nodes) {}
  // The first `owned` nodes belong to this rank.
  DofMap(int num_nodes, const std::vector<bool>& clamped, int owned);

  int num_nodes() const { return static_cast<int>(dof_.size()); }
  int num_owned_nodes() const { return num_owned_nodes_; }
  int num_dofs() const { return num_dofs_; }
  int num_dofs_here() const { return num_dofs_here_; }  // copies included

  // Indices of a node's unknowns: consecutive, except -1 for clamped coordinates.
  const std::array<int, 3>& node(int i) const { return dof_[static_cast<std::size_t>(i)]; }

  // Adds the unknowns to `out`, at the rank's own nodes.
  void add_to(const ConstVectorRef& dofs, NodalVector& out) const;
  // Sets `dofs` to the free coordinates of `nodal`, at the rank's own nodes.
  void restrict_to(const NodalVector& nodal, VectorRef dofs) const;
  // The same two functions for own nodes and copies.
  void add_here_to(const ConstVectorRef& dofs, NodalVector& out) const;
  void restrict_here_to(const NodalVector& nodal, VectorRef dofs) const;

 private:
  template <class Visit>
  void for_each(int nodes, Visit&& visit) const;

  std::vector<std::array<int, 3>> dof_;
  int num_owned_nodes_, num_dofs_ = 0, num_dofs_here_ = 0;
};

}  // namespace orthodyn
