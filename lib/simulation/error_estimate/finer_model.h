// A scene's model with finer elements: linear elements become quadratic, quadratic ones are divided into eight. The
// coarse displacements are a subspace of the fine ones.
//
// The mass matrix is consistent. Models distributed over ranks are not supported.
#pragma once

#include <memory>

#include "lib/scene/build.h"

namespace orthodyn {

// True if a region has the mixed formulation.
bool is_mixed(const FemModel& model);

// True if the finer elements have the same energy as the coarse ones at an interpolated coarse displacement. False for
// mixed elements, because such a displacement changes the volume of the finer elements, and for 20-node hexahedra with
// 8 integration points.
bool is_nested(const FemModel& model);

class FinerModel {
 public:
  // `coarse`: the model of the scene, which must outlive the object. Throws ConfigError if the scene cannot be built
  // with finer elements.
  FinerModel(const Scene& scene, const FemModel& coarse);

  // Approximate number of unknowns of the finer model.
  static double estimated_unknowns(const FemModel& coarse);

  const FemModel& model() const { return *built_.model; }
  const FemModel& coarse() const { return coarse_; }

  // Interpolates the coarse unknowns q at time t (s), together with the displacements of supports. Returns the unknowns
  // of the finer model (m).
  Vector state_of(double t, const ConstVectorRef& q) const;

  // lift() interpolates unknowns as if supports stood still; lower() is its transpose.
  Vector lift(const ConstVectorRef& coarse) const { return lift_ * coarse; }
  Vector lower(const ConstVectorRef& fine) const { return lift_.transpose() * fine; }

 private:
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
  Rows nodal_lift(const Mesh& fine) const;

  const FemModel& coarse_;
  BuiltScene built_;
  Rows nodal_;  // from values at coarse nodes to values at fine nodes
  Rows lift_;   // from coarse to fine unknowns
};

}  // namespace orthodyn
