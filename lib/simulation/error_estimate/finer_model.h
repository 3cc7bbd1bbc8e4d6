// A scene's body with the next finer elements, to test what the elements at hand cannot do: quadratic tetrahedra in the
// place of linear ones, each quadratic one divided in eight. What the coarse elements can do these can, too.
//
// With a consistent mass. Of one process: not of a model that several ranks hold.
#pragma once

#include <memory>

#include "lib/scene/build.h"

namespace orthodyn {

class FinerModel {
 public:
  // `coarse`: the model of the scene, which must outlive this. Throws ConfigError where the scene cannot be built so.
  FinerModel(const Scene& scene, const FemModel& coarse);

  // How many unknowns it will about have.
  static double unknowns_of(const FemModel& coarse);

  const FemModel& model() const { return *built_.model; }
  const FemModel& coarse() const { return coarse_; }

  // The free coordinates of a coarse state, m: of its displacements at the time t, s, with those of its supports.
  Vector state_of(double t, const ConstVectorRef& q) const;

  // The same of free coordinates alone, linear, and its transpose.
  Vector lift(const ConstVectorRef& coarse) const { return lift_ * coarse; }
  Vector lower(const ConstVectorRef& fine) const { return lift_.transpose() * fine; }

 private:
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
  Rows nodal_lift(const TetMesh& fine) const;

  const FemModel& coarse_;
  BuiltScene built_;
  Rows nodal_;  // from a value at the coarse nodes to one at the fine ones
  Rows lift_;   // from coarse to fine unknowns
};

}  // namespace orthodyn
