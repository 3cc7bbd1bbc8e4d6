#include "lib/simulation/error_estimate/whole_states.h"

namespace orthodyn {

std::array<int, 3> unknowns_of(const FemModel& model, int node) {
  const FemModel::Parts& parts = model.parts();
  if (!parts.subdomain) return parts.dofs->node(node);
  std::array<double, 3> unknowns{-1, -1, -1};
  if (parts.subdomain->owns(node))
    for (std::size_t c = 0; c < 3; ++c)
      if (const int dof = parts.dofs->node(parts.subdomain->local(node))[c]; dof >= 0)
        unknowns[c] = parts.unknowns[static_cast<std::size_t>(dof)];
  parts.subdomain->ranks().max(unknowns);
  return {static_cast<int>(unknowns[0]), static_cast<int>(unknowns[1]), static_cast<int>(unknowns[2])};
}

Eigen::MatrixXd times_mass(const FemModel& model, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd out(x.rows(), x.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const Vector part = model.part_of(x.col(k));
    Vector product(part.size());
    model.multiply_mass(part, product);
    out.col(k) = model.whole_of(product);
  }
  return out;
}

}  // namespace orthodyn
