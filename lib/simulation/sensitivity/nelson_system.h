// The singular system (K - lambda M) z = b of Nelson's method (shape_sensitivity.h).
#pragma once

#include <memory>
#include <vector>

#include "lib/core/pattern.h"
#include "lib/linear/solver.h"

namespace orthodyn {

class NelsonSystem {
 public:
  // `K` and `M`: values on `pattern`, which must outlive this object. `shape`: the eigenvector of the simple eigenvalue
  // `lambda`. Throws RunError if the system is singular beside the shape.
  NelsonSystem(const Pattern& pattern, const std::vector<double>& K, const std::vector<double>& M, double lambda,
               const Vector& shape);

  // Returns the z that is 0 at the largest coordinate of the shape. Precondition: b is orthogonal to the shape. Throws
  // RunError if the solution is not accurate.
  Vector solve(Vector b);

 private:
  void factor_with_pivots();
  bool try_to_solve(const Vector& b, Vector& z) const;

  const Pattern& pattern_;
  Eigen::Index fixed_ = 0;
  std::vector<double> values_;  // of K - lambda M, in which the fixed coordinate is decoupled
  std::unique_ptr<LinearSolver> solver_;
  bool pivots_ = false;  // whether the solver pivots for size
};

}  // namespace orthodyn
