// Anderson acceleration of an iteration x <- x + g(x) (Anderson 1965; Walker & Ni, SIAM J. Numer. Anal. 49, 2011). The
// next iterate is a weighted mean of x_i + g(x_i) over the last iterates x_i. The weights minimise the norm of the same
// weighted mean of the g(x_i). For a linear g the iteration converges about as fast as GMRES. Not thread-safe, because
// it keeps iterates.
#pragma once

#include <algorithm>

#include "lib/core/types.h"

namespace orthodyn {

class Anderson {
 public:
  // `depth`: number of earlier iterates used, at least 1.
  Anderson(Eigen::Index size, int depth) : dx_(size, depth), dg_(size, depth), x_(size), g_(size) {}

  // Discards earlier iterates; call it for a new equation.
  void restart() { count_ = 0; }

  // In: the iterate x and its correction g(x). Out: the accelerated correction in g, to be added to x.
  void accelerate(const ConstVectorRef& x, VectorRef g) {
    if (count_ > 0) {
      const Eigen::Index at = (count_ - 1) % dx_.cols();
      dx_.col(at) = x - x_;
      dg_.col(at) = g - g_;
    }
    x_ = x;
    g_ = g;
    const Eigen::Index kept = std::min(count_++, dx_.cols());
    if (kept == 0) return;
    const Vector weights = dg_.leftCols(kept).colPivHouseholderQr().solve(g_);
    g -= (dx_.leftCols(kept) + dg_.leftCols(kept)) * weights;
  }

 private:
  Eigen::MatrixXd dx_, dg_;  // differences of successive iterates and of their corrections
  Vector x_, g_;             // the latest iterate and its correction
  Eigen::Index count_ = 0;
};

}  // namespace orthodyn
