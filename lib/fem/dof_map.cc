#include "lib/fem/dof_map.h"

namespace orthodyn {

DofMap::DofMap(int num_nodes, const std::vector<bool>& clamped)
    : dof_(static_cast<std::size_t>(num_nodes)) {
  std::size_t coordinate = 0;
  for (auto& node : dof_)
    for (int& dof : node) dof = clamped[coordinate++] ? -1 : num_dofs_++;
}

void DofMap::add_to(const ConstVectorRef& dofs, NodalVector& out) const {
  for (int i = 0; i < num_nodes(); ++i)
    for (int k = 0; k < 3; ++k)
      if (const int j = node(i)[static_cast<std::size_t>(k)]; j >= 0) out(k, i) += dofs[j];
}

void DofMap::restrict_to(const NodalVector& nodal, VectorRef dofs) const {
  for (int i = 0; i < num_nodes(); ++i)
    for (int k = 0; k < 3; ++k)
      if (const int j = node(i)[static_cast<std::size_t>(k)]; j >= 0) dofs[j] = nodal(k, i);
}

}  // namespace orthodyn
