#include "lib/fem/support_mass.h"

namespace orthodyn {

namespace {

bool is_held(const DofMap& dofs, int node) {
  const auto& unknowns = dofs.node(node);
  return unknowns[0] < 0 || unknowns[1] < 0 || unknowns[2] < 0;
}

}  // namespace

SupportMass::SupportMass(const Mass& mass, const TetMesh& mesh, const std::vector<double>& density, const DofMap& dofs)
    : matrix_(dofs.num_nodes(), dofs.num_nodes()) {
  std::vector<Eigen::Triplet<double>> entries;
  if (mass.lumped()) {
    for (int i = 0; i < dofs.num_nodes(); ++i)
      if (is_held(dofs, i)) entries.emplace_back(i, i, mass.nodal()[i]);
  } else {
    for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
      const double share = density[e] * signed_volume6(mesh, mesh.tets[e]) / 120;
      for (const int a : mesh.tets[e])
        for (const int b : mesh.tets[e])
          if (is_held(dofs, a) || is_held(dofs, b)) entries.emplace_back(a, b, (a == b ? 2 : 1) * share);
    }
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
