// The mass of the free coordinates: lumped (diagonal) or consistent (on the model's pattern).
//
//     M_ab = integral of rho N_a N_b dV (consistent),  m_a = rho V s_a of each element with its shares s_a (lumped);
//
// one number, kg, for the three coordinates of a node. Const functions may run at the same time on different vectors.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "lib/fem/block_pattern.h"
#include "lib/fem/element_mesh.h"
#include "lib/fem/subdomain.h"
#include "lib/linear/solver.h"

namespace orthodyn {

enum class MassKind { lumped, consistent };

class Mass {
 public:
  // density[cell] in kg/m^3. `pattern` must outlive the mass; `dofs` need not.
  // `subdomain`: of a lumped mass of which several ranks have parts; else null.
  Mass(MassKind kind, const ElementMesh& mesh, const std::vector<double>& density, const DofMap& dofs,
       const BlockPattern& pattern, const Subdomain* subdomain = nullptr);
  ~Mass();

  bool lumped() const { return kind_ == MassKind::lumped; }
  // kg, clamped nodes included.
  double total() const { return total_; }
  // The lumped masses of all nodes, kg, for either kind; 0 of copies of other ranks' nodes.
  const Vector& nodal() const { return nodal_; }
  // The row sums of the whole mass matrix, kg: what a uniform acceleration of all nodes takes. Those of a consistent
  // mass may be negative.
  const Vector& row_sums() const { return lumped() ? nodal_ : row_sums_; }
  // By what squared frequencies with this mass can exceed those with nodal(); 1 if lumped.
  double frequency_excess() const { return frequency_excess_; }
  // Taken, the factorisation included if there is one.
  std::size_t bytes() const;

  // y = M x; x and y differ.
  void multiply(const ConstVectorRef& x, VectorRef y) const;
  // x <- M^-1 x. The consistent mass is factored at the first call, which throws RunError if it is not positive
  // definite; calls wait for each other.
  void solve(VectorRef x) const;
  // values += factor * M
  void add_to(double factor, double* values) const;

 private:
  void add_consistent(const ElementMesh& mesh, const std::vector<double>& density, const BlockPattern& pattern);

  MassKind kind_;
  const Pattern& pattern_;
  Vector nodal_;
  double total_ = 0, frequency_excess_;
  Vector diagonal_;             // lumped
  Vector row_sums_;             // consistent
  std::vector<double> values_;  // consistent

  // Of a consistent mass. A solver has workspace of its own: one solve at a time.
  mutable std::mutex solving_;
  mutable std::unique_ptr<LinearSolver> solver_;
  mutable bool factored_ = false;
};

}  // namespace orthodyn
