// Which coordinates of which nodes are unknowns. Clamped coordinates are no part of the system.
#pragma once

#include <array>
#include <vector>

#include "lib/core/types.h"

namespace orthodyn {

using NodalVector = Eigen::Matrix<double, 3, Eigen::Dynamic>;  // a column per node

class DofMap {
 public:
  // clamped[3 * node + component]
  DofMap(int num_nodes, const std::vector<bool>& clamped);

  int num_nodes() const { return static_cast<int>(dof_.size()); }
  int num_dofs() const { return num_dofs_; }

  // The three unknowns of a node, -1 where clamped; free ones are consecutive.
  const std::array<int, 3>& node(int i) const { return dof_[static_cast<std::size_t>(i)]; }

  // out = base with the unknowns added to it.
  void add_to(const ConstVectorRef& dofs, NodalVector& out) const;
  // The free coordinates of a nodal vector.
  void restrict_to(const NodalVector& nodal, VectorRef dofs) const;

 private:
  std::vector<std::array<int, 3>> dof_;
  int num_dofs_ = 0;
};

}  // namespace orthodyn
