// A x = b for a symmetric positive definite A of a fine space that holds a coarse one: conjugate gradients,
// preconditioned by the sum of the coarse solution and an incomplete factor of A (a two-level additive Schwarz method;
// Smith, Bjorstad & Gropp 1996, Domain Decomposition, ch. 2).
//
// Of energy, x' A x, each iteration adds a part (Hestenes & Stiefel 1952): it stops where the last ones add little, and
// what it has found is a lower bound.
#pragma once

#include <functional>
#include <memory>

#include "lib/linear/solver.h"

namespace orthodyn {

class TwoLevelSolver {
 public:
  // The solution of the coarse problem for a right side of the fine one, in the fine space: P A_coarse^-1 P' b.
  using CoarseSolution = std::function<Vector(const ConstVectorRef&)>;

  // `values` of A on the pattern; both must outlive it.
  TwoLevelSolver(const Pattern& pattern, const std::vector<double>& values, CoarseSolution coarse);
  ~TwoLevelSolver();

  struct Solution {
    Vector x;
    double energy = 0;  // x' A x
    int iterations = 0;
    bool converged = false;
  };
  // `accuracy`: the share of the energy that may be missing. `most`: iterations. Throws IndefiniteMatrix.
  Solution solve(const ConstVectorRef& b, double accuracy, int most) const;

 private:
  class Smoother;
  const Pattern& pattern_;
  const std::vector<double>& values_;
  CoarseSolution coarse_;
  std::unique_ptr<Smoother> smoother_;
};

}  // namespace orthodyn
