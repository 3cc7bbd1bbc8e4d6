#include "lib/fem/dof_map.h"

#include <utility>

namespace orthodyn {

DofMap::DofMap(int num_nodes, const std::vector<bool>& clamped, int owned, Ties ties)
    : dof_(static_cast<std::size_t>(num_nodes)), ties_(std::move(ties)), num_owned_nodes_(owned) {
  std::size_t coordinate = 0;
  for (int i = 0; i < num_nodes; ++i) {
    for (int& dof : dof_[static_cast<std::size_t>(i)])
      dof = clamped[coordinate++] || ties_.is_tied(i) ? -1 : num_dofs_here_++;
    if (i < owned) num_dofs_ = num_dofs_here_;
  }
}

// Calls visit(component, node, dof) for the unknowns of the first `nodes` nodes.
template <class Visit>
void DofMap::for_each(int nodes, Visit&& visit) const {
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < 3; ++k)
      if (const int j = node(i)[static_cast<std::size_t>(k)]; j >= 0) visit(k, i, j);
}

void DofMap::add_to(const ConstVectorRef& dofs, NodalVector& out) const {
  add_forces_to(dofs, out);
  for (const TiedNode& tied : ties_.nodes())
    for (const auto& [leader, weight] : tied.leaders)
      for (int k = 0; k < 3; ++k)
        if (const int j = node(leader)[static_cast<std::size_t>(k)]; j >= 0) out(k, tied.node) += weight * dofs[j];
}

void DofMap::add_forces_to(const ConstVectorRef& dofs, NodalVector& out) const {
  for_each(num_owned_nodes_, [&](int k, int i, int j) { out(k, i) += dofs[j]; });
}

void DofMap::restrict_to(const NodalVector& nodal, VectorRef dofs) const {
  for_each(num_owned_nodes_, [&](int k, int i, int j) { dofs[j] = nodal(k, i); });
}

void DofMap::restrict_forces_to(const NodalVector& nodal, VectorRef dofs) const {
  restrict_to(nodal, dofs);
  for (const TiedNode& tied : ties_.nodes())
    for (const auto& [leader, weight] : tied.leaders)
      for (int k = 0; k < 3; ++k)
        if (const int j = node(leader)[static_cast<std::size_t>(k)]; j >= 0) dofs[j] += weight * nodal(k, tied.node);
}

void DofMap::add_here_to(const ConstVectorRef& dofs, NodalVector& out) const {
  for_each(num_nodes(), [&](int k, int i, int j) { out(k, i) += dofs[j]; });
}

void DofMap::restrict_here_to(const NodalVector& nodal, VectorRef dofs) const {
  for_each(num_nodes(), [&](int k, int i, int j) { dofs[j] = nodal(k, i); });
}

}  // namespace orthodyn
