// Which coordinates of which nodes are unknowns. Clamped coordinates are no part of the system.
//
// Of several ranks each has nodes of its own, and after them copies of other ranks' nodes (subdomain.h). The copies'
// coordinates have numbers as well, for matrices; vectors of unknowns have those of its own nodes alone.
#pragma once

#include <array>
#include <vector>

#include "lib/core/types.h"

namespace orthodyn {

using NodalVector = Eigen::Matrix<double, 3, Eigen::Dynamic>;  // a column per node

class DofMap {
 public:
  // clamped[3 * node + component]
  DofMap(int num_nodes, const std::vector<bool>& clamped) : DofMap(num_nodes, clamped, num_nodes) {}
  // The first `owned` nodes are this rank's.
  DofMap(int num_nodes, const std::vector<bool>& clamped, int owned);

  int num_nodes() const { return static_cast<int>(dof_.size()); }
  int num_owned_nodes() const { return num_owned_nodes_; }
  int num_dofs() const { return num_dofs_; }
  // The copies' included.
  int num_dofs_here() const { return num_dofs_here_; }

  // The three unknowns of a node, -1 where clamped; free ones are consecutive.
  const std::array<int, 3>& node(int i) const { return dof_[static_cast<std::size_t>(i)]; }

  // out = base with the unknowns added to it.
  void add_to(const ConstVectorRef& dofs, NodalVector& out) const;
  // The free coordinates of a nodal vector.
  void restrict_to(const NodalVector& nodal, VectorRef dofs) const;
  // The same with those of the copies.
  void add_here_to(const ConstVectorRef& dofs, NodalVector& out) const;
  void restrict_here_to(const NodalVector& nodal, VectorRef dofs) const;

 private:
  template <class Visit>
  void for_each(int nodes, Visit&& visit) const;

  std::vector<std::array<int, 3>> dof_;
  int num_owned_nodes_, num_dofs_ = 0, num_dofs_here_ = 0;
};

}  // namespace orthodyn
