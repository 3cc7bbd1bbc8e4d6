// The mass of the free coordinates: lumped (diagonal) or consistent (on the model's pattern).
#pragma once

#include <memory>
#include <vector>

#include "lib/fem/block_pattern.h"
#include "lib/linear/solver.h"

namespace orthodyn {

enum class MassKind { lumped, consistent };

class Mass {
 public:
  // density[cell] in kg/m^3. `pattern` and `dofs` must outlive the mass.
  Mass(MassKind kind, const TetMesh& mesh, const std::vector<double>& density, const DofMap& dofs,
       const BlockPattern& pattern);
  ~Mass();

  bool lumped() const { return kind_ == MassKind::lumped; }
  double total() const { return nodal_.sum(); }          // kg, clamped nodes included
  const Vector& nodal() const { return nodal_; }         // row sums, kg per node
  std::size_t bytes() const;

  void multiply(const ConstVectorRef& x, VectorRef y) const;
  void solve(VectorRef x) const;
  // values += factor * M
  void add_to(double factor, double* values) const;

 private:
  MassKind kind_;
  const Pattern& pattern_;
  Vector nodal_;
  Vector diagonal_;                       // lumped
  std::vector<double> values_;            // consistent
  std::unique_ptr<LinearSolver> solver_;  // consistent: factored at the first solve
  mutable bool factored_ = false;
};

}  // namespace orthodyn
