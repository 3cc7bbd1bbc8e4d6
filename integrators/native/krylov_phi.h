// phi_k(h J) b of a large J by Arnoldi's method, with phi_0 = exp, phi_k(z) = (phi_{k-1}(z) - 1/(k-1)!) / z.
//
// From J V = V H + eta v_{m+1} e_m^T and b = beta v_1,
//     phi_k(h J) b ~ beta (V phi_k(h H) e_1 + h eta [phi_{k+1}(h H) e_1]_m v_{m+1}),
// whose last part is the estimate of the error without it (Saad 1992, 5). The small functions are columns of
// one exponential (Al-Mohy & Higham 2011, theorem 2.1). The space grows until the estimate is small. Not thread-safe.
#pragma once

#include <functional>

#include "lib/core/types.h"

namespace orthodyn {

class KrylovPhi {
 public:
  using Operator = std::function<void(const Eigen::Ref<const Vector>& x, VectorRef y)>;  // y = J x

  KrylovPhi(Eigen::Index size, int max_dimension);

  // Begins a space for a vector of the given size. `J` is called by apply() too and must not change until the next
  // begin().
  void begin(const Operator& J, const Vector& b);

  // out = phi_k(h J) b for any k >= 1 and h; false if its error, root mean square, would exceed the tolerance in
  // the largest space. Throws RecoverableError where J is not finite.
  bool apply(int k, double h, double tolerance, Vector& out);

  int dimension() const { return dimension_; }
  std::size_t bytes() const { return static_cast<std::size_t>(basis_.size()) * sizeof(double); }

 private:
  void grow();
  // Columns phi_1(h H) e_1 to phi_count(h H) e_1.
  Eigen::MatrixXd small_phi(double h, int count) const;

  Operator J_;
  int max_dimension_, dimension_ = 0;
  bool invariant_ = false;  // the space cannot and need not grow
  double beta_ = 0;
  Eigen::MatrixXd basis_, hessenberg_;
};

}  // namespace orthodyn
