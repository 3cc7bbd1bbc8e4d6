#include "lib/fem/support_mass.h"

#include <span>

namespace orthodyn {

namespace {

bool is_held(const DofMap& dofs, int node) {
  const auto& unknowns = dofs.node(node);
  return unknowns[0] < 0 || unknowns[1] < 0 || unknowns[2] < 0;
}

using Entries = std::vector<Eigen::Triplet<double>>;

void add_element(std::span<const int> nodes, const Eigen::MatrixXd& M, const DofMap& dofs, Entries& entries) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (is_held(dofs, nodes[i]) || is_held(dofs, nodes[j]))
        entries.emplace_back(nodes[i], nodes[j], M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
}

}  // namespace

SupportMass::SupportMass(const Mass& mass, const ElementMesh& mesh, const std::vector<double>& density,
                         const DofMap& dofs)
    : matrix_(dofs.num_nodes(), dofs.num_nodes()) {
  Entries entries;
  if (mass.lumped()) {
    for (int i = 0; i < dofs.num_nodes(); ++i)
      if (is_held(dofs, i)) entries.emplace_back(i, i, mass.nodal()[i]);
  } else {
    for (std::size_t e = 0; e < mesh.cells.size(); ++e)
      add_element(mesh.cells[e], mesh.type.consistent_mass(mesh.positions(e), density[e]), dofs, entries);
  }
  matrix_.setFromTriplets(entries.begin(), entries.end());
}

std::size_t SupportMass::bytes() const {
  return static_cast<std::size_t>(matrix_.nonZeros()) * (sizeof(double) + sizeof(int)) +
         static_cast<std::size_t>(matrix_.cols() + 1) * sizeof(int);
}

NodalVector held_part(const DofMap& dofs, const NodalVector& x) {
  NodalVector out = x;
  for (int i = 0; i < dofs.num_nodes(); ++i)
    for (int c = 0; c < 3; ++c)
      if (dofs.node(i)[static_cast<std::size_t>(c)] >= 0) out(c, i) = 0;
  return out;
}

}  // namespace orthodyn
