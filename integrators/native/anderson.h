// Anderson's acceleration of an iteration x <- x + g(x) (Anderson 1965; Walker & Ni, SIAM J. Numer. Anal. 49,
// 2011): the next iterate combines the latest ones so that the same combination of their corrections is smallest.
// A linearly convergent iteration becomes about as fast as GMRES on its matrix. Remembers iterates: not thread-safe.
#pragma once

#include <algorithm>

#include "lib/core/types.h"

namespace orthodyn {

class Anderson {
 public:
  Anderson(Eigen::Index size, int depth) : dx_(size, depth), dg_(size, depth), x_(size), g_(size) {}

  // Forgets earlier iterates: a new equation.
  void restart() { met_ = 0; }

  // In: the iterate x and its correction g(x). Out: g is the accelerated correction, to be added to x.
  void accelerate(const ConstVectorRef& x, VectorRef g) {
    if (met_ > 0) {
      const Eigen::Index at = (met_ - 1) % dx_.cols();
      dx_.col(at) = x - x_;
      dg_.col(at) = g - g_;
    }
    x_ = x;
    g_ = g;
    const Eigen::Index kept = std::min(met_++, dx_.cols());
    if (kept == 0) return;
    const Vector weights = dg_.leftCols(kept).colPivHouseholderQr().solve(g_);
    g -= (dx_.leftCols(kept) + dg_.leftCols(kept)) * weights;
  }

 private:
  Eigen::MatrixXd dx_, dg_;  // differences of successive iterates, and of their corrections
  Vector x_, g_;             // the latest
  Eigen::Index met_ = 0;
};

}  // namespace orthodyn
