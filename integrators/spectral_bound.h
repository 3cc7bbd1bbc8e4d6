// An upper bound of the largest eigenvalue lambda of A x = lambda M x, for a matrix A on a model's pattern, by Lanczos'
// method in the inner product of M. An unsymmetric A is replaced by its symmetric part.
//
// The bound is the largest Ritz value plus the norm of its residual (Zhou & Li, Linear Algebra Appl. 435, 2011). It is
// valid if the start vector has a component in the highest mode, as a random vector has.
#pragma once

#include "lib/ode/model.h"

namespace orthodyn {

class SpectralBound {
 public:
  // `model` must outlive this object.
  explicit SpectralBound(const Model& model);

  // The bound, at least 0, for A with `values` on model.pattern(): in 1/s^2 for a stiffness, in 1/s for a damping
  // matrix. The iteration starts from the Ritz vector of the last call plus a small random part, so it is cheap if A
  // has changed little. Not thread-safe, because the Ritz vector is kept.
  double largest(const double* values);

 private:
  struct Basis;
  void multiply(const double* values, const Vector& x, Vector& y) const;
  Vector start() const;

  const Model& model_;
  Vector random_, ritz_;
  bool is_warm_ = false;  // ritz_ is set
};

}  // namespace orthodyn
