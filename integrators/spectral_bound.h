// An upper bound of the largest eigenvalue of A x = lambda M x, for matrices on a model's pattern, by
// Lanczos' method in the inner product of M.
//
// The residual's norm is added to the largest Ritz value (Zhou & Li, Linear Algebra Appl. 435, 2011): a bound
// once the start has a part in the largest mode, which a random one has. A is replaced by its symmetric part.
#pragma once

#include "lib/ode/model.h"

namespace orthodyn {

class SpectralBound {
 public:
  // `model` must outlive this.
  explicit SpectralBound(const Model& model);

  // `values` on model.pattern(). In the unit of A over that of M: 1/s^2 for a stiffness, 1/s for a damping matrix. At
  // least 0. Begins with the last call's Ritz vector: cheap where little has changed. Not thread-safe for this reason.
  double largest(const double* values);

 private:
  struct Basis;
  void multiply(const double* values, const Vector& x, Vector& y) const;
  Vector start() const;

  const Model& model_;
  Vector random_, ritz_;
  bool is_warm_ = false;  // ritz_ is of an earlier call
};

}  // namespace orthodyn
