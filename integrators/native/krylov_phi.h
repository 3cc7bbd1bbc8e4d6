// Computes phi_k(h J) b for a large matrix J by Arnoldi's method, where
//
//     phi_0(z) = exp(z),   phi_k(z) = (phi_{k-1}(z) - 1/(k-1)!) / z.
//
// The columns v_1 to v_m of V are an orthonormal basis of the Krylov space of b = beta v_1, H is upper Hessenberg and
// e_i a unit vector. From J V = V H + eta v_{m+1} e_m^T follows
//
//     phi_k(h J) b ~ beta (V phi_k(h H) e_1 + h eta [phi_{k+1}(h H) e_1]_m v_{m+1}).
//
// The second term is the error estimate of the first (Saad 1992, section 5); apply() returns the sum.
// The phi_k(h H) e_1 are columns of one exponential (Al-Mohy & Higham 2011, theorem 2.1). The space grows until the
// estimate is small. Not thread-safe.
#pragma once

#include <functional>

#include "lib/core/types.h"

namespace orthodyn {

class KrylovPhi {
 public:
  using Operator = std::function<void(const Eigen::Ref<const Vector>& x, VectorRef y)>;  // y = J x

  KrylovPhi(Eigen::Index size, int max_dimension);

  // Starts the Krylov space of b. apply() calls `J` to enlarge the space: J must not change until the next begin().
  void begin(const Operator& J, const Vector& b);

  // Computes out = phi_k(h J) b for any k >= 1 and h. False if the root mean square of the error exceeds `tolerance`
  // even in the largest space. Throws RecoverableError if J is not finite.
  bool apply(int k, double h, double tolerance, Vector& out);

  int dimension() const { return dimension_; }
  std::size_t bytes() const { return static_cast<std::size_t>(basis_.size()) * sizeof(double); }

 private:
  void grow();
  // Returns the columns phi_1(h H) e_1 to phi_count(h H) e_1.
  Eigen::MatrixXd small_phi(double h, int count) const;

  Operator J_;
  int max_dimension_, dimension_ = 0;
  bool invariant_ = false;  // the space is invariant: it cannot and need not grow
  double beta_ = 0;
  Eigen::MatrixXd basis_, hessenberg_;
};

}  // namespace orthodyn
