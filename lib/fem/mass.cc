#include "lib/fem/mass.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

// Calls visit(nodes, consistent mass matrix) for each cell and each frame.
template <class Visit>
void for_each_block(const ElementMesh& mesh, const MassSources& sources, Visit&& visit) {
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    visit(mesh.cells[e], mesh.type(e).consistent_mass(mesh.positions(e), sources.density[e]));
  for (const FrameMass& mass : sources.frames) visit(std::span<const int>(mass.frame), Eigen::MatrixXd(mass.matrix));
}

}  // namespace

Mass::Mass(MassKind kind, const ElementMesh& mesh, const MassSources& sources, const DofMap& dofs,
           const BlockPattern& pattern, const Subdomain* subdomain)
    : kind_(kind), pattern_(pattern.pattern()), nodal_(Vector::Zero(dofs.num_nodes())), frequency_excess_(1) {
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const ElementType& type = mesh.type(e);
    const Vector masses = type.lumped_mass(mesh.positions(e), sources.density[e]);
    if (kind == MassKind::consistent) frequency_excess_ = std::max(frequency_excess_, type.lumped_to_consistent());
    Eigen::Index a = 0;
    for (const int node : mesh.cells[e]) nodal_[node] += masses[a++];
  }
  for (const FrameMass& mass : sources.frames)
    for (const int node : mass.nodes) nodal_[node] += mass.total() / static_cast<double>(mass.nodes.size());
  if (subdomain) subdomain->add_to_owners(nodal_);
  if (kind == MassKind::lumped) move_to_leaders(dofs.ties());
  total_ = subdomain ? subdomain->ranks().sum(nodal_.sum()) : nodal_.sum();
  if (kind == MassKind::lumped) {
    diagonal_.resize(dofs.num_dofs());
    const NodalVector all = Vec3::Ones() * nodal_.transpose();
    dofs.restrict_to(all, diagonal_);
  } else {
    add_consistent(mesh, sources, pattern);
  }
}

// A tied node's mass m_s is divided among its leaders by p_i = |w_i| / sum |w_j|, which is positive. By Cauchy's
// inequality (sum w_i v_i)^2 <= (sum |w_j|)^2 sum p_i v_i^2, which bounds the kinetic energy of the tied nodes.
void Mass::move_to_leaders(const Ties& ties) {
  if (ties.empty()) return;
  Vector bounds = nodal_;
  tied_ = Vector::Zero(nodal_.size());
  ties.move_bounds(bounds);
  for (const TiedNode& tied : ties.nodes()) {
    for (const auto& [leader, weight] : tied.leaders)
      nodal_[leader] += std::abs(weight) / tied.sum_of_magnitudes() * nodal_[tied.node];
    tied_[tied.node] = std::exchange(nodal_[tied.node], 0);
  }
  for (const TiedNode& tied : ties.nodes())
    for (const auto& [leader, weight] : tied.leaders)
      frequency_excess_ = std::max(frequency_excess_, bounds[leader] / nodal_[leader]);
}

void Mass::add_consistent(const ElementMesh& mesh, const MassSources& sources, const BlockPattern& pattern) {
  values_.assign(pattern_.row.size(), 0);
  row_sums_ = Vector::Zero(nodal_.size());
  for_each_block(mesh, sources, [&](std::span<const int> nodes, const Eigen::MatrixXd& M) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      row_sums_[nodes[i]] += M.row(static_cast<Eigen::Index>(i)).sum();
      for (std::size_t j = 0; j < nodes.size(); ++j) {
        const int a = nodes[i], b = nodes[j];
        if (pattern.symmetric() && a < b) continue;
        const double m = M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        pattern.add(a, b, pattern.offset(a, b), m * Mat3::Identity(), values_.data());
      }
    }
  });
}

Mass::~Mass() = default;

std::size_t Mass::bytes() const {
  const std::lock_guard lock(solving_);
  return static_cast<std::size_t>(nodal_.size() + diagonal_.size() + row_sums_.size()) * sizeof(double) +
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
  const std::lock_guard lock(solving_);
  if (!factored_) {
    solver_ = make_solver_for(pattern_);
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
  for (int j = 0; j < static_cast<int>(diagonal_.size()); ++j) {
    auto at = static_cast<std::size_t>(pattern_.column_start[static_cast<std::size_t>(j)]);
    if (!pattern_.symmetric)
      while (pattern_.row[at] != j) ++at;
    values[at] += factor * diagonal_[j];
  }
}

namespace {

bool is_held(const DofMap& dofs, int node) {
  const auto& unknowns = dofs.node(node);
  return unknowns[0] < 0 || unknowns[1] < 0 || unknowns[2] < 0;
}

using Entries = std::vector<Eigen::Triplet<double>>;

// Adds the mass m between two nodes, or between their leaders, if one of them is held.
void add_entry(int i, int j, double m, const DofMap& dofs, Entries& entries) {
  dofs.ties().for_each_leader(i, [&](int a, double of_i) {
    dofs.ties().for_each_leader(j, [&](int b, double of_j) {
      if (is_held(dofs, a) || is_held(dofs, b)) entries.emplace_back(a, b, of_i * of_j * m);
    });
  });
}

void add_block(std::span<const int> nodes, const Eigen::MatrixXd& M, const DofMap& dofs, Entries& entries) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < nodes.size(); ++j)
      add_entry(nodes[i], nodes[j], M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), dofs, entries);
}

}  // namespace

SupportMass::SupportMass(const Mass& mass, const ElementMesh& mesh, const MassSources& sources, const DofMap& dofs)
    : matrix_(dofs.num_nodes(), dofs.num_nodes()) {
  Entries entries;
  if (mass.lumped()) {
    for (int i = 0; i < dofs.num_nodes(); ++i)
      if (is_held(dofs, i)) entries.emplace_back(i, i, mass.nodal()[i]);
  } else {
    for_each_block(mesh, sources,
                   [&](std::span<const int> nodes, const Eigen::MatrixXd& M) { add_block(nodes, M, dofs, entries); });
  }
  matrix_.setFromTriplets(entries.begin(), entries.end());
}

std::size_t SupportMass::bytes() const {
  return static_cast<std::size_t>(matrix_.nonZeros()) * (sizeof(double) + sizeof(int)) +
         static_cast<std::size_t>(matrix_.cols() + 1) * sizeof(int);
}

TiedMass::TiedMass(const ElementMesh& mesh, const std::vector<double>& density, const Ties& ties)
    : transpose_(std::ssize(mesh.nodes), std::ssize(mesh.nodes)) {
  Entries entries;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const auto nodes = mesh.cells[e];
    if (std::none_of(nodes.begin(), nodes.end(), [&](int node) { return ties.is_tied(node); })) continue;
    const Eigen::MatrixXd M = mesh.type(e).consistent_mass(mesh.positions(e), density[e]);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size() && ties.is_tied(nodes[i]); ++j)
        entries.emplace_back(nodes[j], nodes[i], M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  }
  transpose_.setFromTriplets(entries.begin(), entries.end());
}

NodalVector held_part(const DofMap& dofs, const NodalVector& x) {
  NodalVector out = x;
  for (int i = 0; i < dofs.num_nodes(); ++i)
    for (int c = 0; c < 3; ++c)
      if (dofs.node(i)[static_cast<std::size_t>(c)] >= 0) out(c, i) = 0;
  return out;
}

}  // namespace orthodyn
