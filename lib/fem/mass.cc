#include "lib/fem/mass.h"

#include <algorithm>

#include "lib/core/errors.h"

namespace orthodyn {

Mass::Mass(MassKind kind, const TetMesh& mesh, const std::vector<double>& density, const DofMap& dofs,
           const BlockPattern& pattern)
    : kind_(kind), pattern_(pattern.pattern()), nodal_(Vector::Zero(dofs.num_nodes())) {
  if (kind == MassKind::consistent) values_.assign(pattern_.row.size(), 0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const Tet& tet = mesh.tets[e];
    const double mass = density[e] * signed_volume6(mesh, tet) / 6;
    for (const int node : tet) nodal_[node] += mass / 4;
    if (kind == MassKind::lumped) continue;
    for (const int a : tet)
      for (const int b : tet)
        if (!pattern.symmetric() || a >= b)
          pattern.add(a, b, pattern.offset(a, b), (a == b ? 2 : 1) * mass / 20 * Mat3::Identity(),
                      values_.data());
  }
  if (kind == MassKind::lumped) {
    diagonal_.resize(dofs.num_dofs());
    const NodalVector all = Vec3::Ones() * nodal_.transpose();
    dofs.restrict_to(all, diagonal_);
  } else {
    solver_ = solver_registry().at("cholmod").make();
  }
}

Mass::~Mass() = default;

std::size_t Mass::bytes() const {
  return static_cast<std::size_t>(nodal_.size() + diagonal_.size()) * sizeof(double) +
         values_.capacity() * sizeof(double) + (factored_ ? solver_->factor_bytes() : 0);
}

void Mass::multiply(const ConstVectorRef& x, VectorRef y) const {
  if (lumped()) y = diagonal_.cwiseProduct(x);
  else pattern_.multiply(values_.data(), x, y);
}

void Mass::solve(VectorRef x) const {
  if (lumped()) {
    x.array() /= diagonal_.array();
    return;
  }
  if (!factored_) {
    solver_->analyze(pattern_);
    if (solver_->factor(values_.data()) != FactorStatus::ok)
      throw RunError("the consistent mass matrix is not positive definite; use `mass: lumped`");
    factored_ = true;
  }
  solver_->solve(x, x);
}

void Mass::add_to(double factor, double* values) const {
  if (!lumped()) {
    for (std::size_t k = 0; k < values_.size(); ++k) values[k] += factor * values_[k];
    return;
  }
  for (int j = 0; j < pattern_.n; ++j) {
    auto at = static_cast<std::size_t>(pattern_.column_start[static_cast<std::size_t>(j)]);
    if (!pattern_.symmetric) while (pattern_.row[at] != j) ++at;
    values[at] += factor * diagonal_[j];
  }
}

}  // namespace orthodyn
