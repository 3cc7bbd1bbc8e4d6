// Solves A x = b for a symmetric positive definite A on a fine space that contains a coarse space: conjugate gradients,
// preconditioned by the coarse solution plus a symmetric sweep of Gauss and Seidel (two-level additive Schwarz method;
// Smith, Bjorstad & Gropp 1996, Domain Decomposition, ch. 2). Several right-hand sides are solved together, which reads
// A once for four of them.
//
// Each iteration increases the energy x^T A x (Hestenes & Stiefel 1952). The iteration stops when the last four
// increases together are at most `accuracy` times the energy. This energy is a lower bound of the exact energy.
#pragma once

#include <functional>
#include <vector>

#include "lib/linear/solver.h"

namespace orthodyn {

class TwoLevelSolver {
 public:
  // Returns the coarse solution P A_coarse^-1 P^T b for a right-hand side b of the fine space, with the prolongation P.
  using CoarseSolution = std::function<Vector(const ConstVectorRef&)>;

  // `values`: entries of A on the symmetric pattern. `pattern` and `values` must outlive this object. Throws
  // IndefiniteMatrix if a diagonal entry is not positive.
  TwoLevelSolver(const Pattern& pattern, const std::vector<double>& values, CoarseSolution coarse);

  struct Solution {
    Vector x;
    double energy = 0;  // x^T A x
    int iterations = 0;
    bool converged = false;
  };
  // Solves for each column of b. `accuracy`: allowed relative error of the energy. Throws IndefiniteMatrix if A is not
  // positive definite.
  std::vector<Solution> solve(const Eigen::MatrixXd& b, double accuracy, int max_iterations) const;

 private:
  class LowerTriangle;

  template <int kColumns>
  void solve_group(const Eigen::Ref<const Eigen::MatrixXd>& b, double accuracy, int max_iterations,
                   std::vector<Solution>& out) const;

  const Pattern& pattern_;
  const std::vector<double>& values_;
  CoarseSolution coarse_;
  Vector diagonal_;
};

}  // namespace orthodyn
