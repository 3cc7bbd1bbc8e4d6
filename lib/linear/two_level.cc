#include "lib/linear/two_level.h"

#include <algorithm>
#include <utility>

namespace orthodyn {

// A symmetric sweep of Gauss and Seidel, which needs no set-up: r -> (D + L)^-T D (D + L)^-1 r for A = L + D + L^T.
Vector TwoLevelSolver::smoothed(const Vector& r) const {
  const auto lower = pattern_.matrix(values_.data());
  Vector z = lower.triangularView<Eigen::Lower>().solve(r);
  z.array() *= diagonal_.array();
  lower.transpose().triangularView<Eigen::Upper>().solveInPlace(z);
  return z;
}

TwoLevelSolver::TwoLevelSolver(const Pattern& pattern, const std::vector<double>& values, CoarseSolution coarse)
    : pattern_(pattern), values_(values), coarse_(std::move(coarse)), diagonal_(pattern.n) {
  for (int j = 0; j < pattern.n; ++j)  // the first entry of a column of the lower triangle
    diagonal_[j] = values[static_cast<std::size_t>(pattern.column_start[static_cast<std::size_t>(j)])];
  if (!(diagonal_.array() > 0).all()) throw IndefiniteMatrix("the matrix has a diagonal entry that is not positive");
}

TwoLevelSolver::Solution TwoLevelSolver::solve(const ConstVectorRef& b, double accuracy, int max_iterations) const {
  constexpr int kLastGains = 4;  // iterations whose gains are compared with the energy
  Solution out{Vector::Zero(b.size())};
  Vector r = b, Ap(b.size());
  const auto preconditioned = [&] { return Vector(smoothed(r) + coarse_(r)); };
  Vector z = preconditioned(), p = z;
  double rz = r.dot(z);
  std::vector<double> gains;
  while (out.iterations < max_iterations && rz > 0) {
    pattern_.multiply(values_.data(), p, Ap);
    const double curvature = p.dot(Ap);
    if (!(curvature > 0)) throw IndefiniteMatrix("the matrix is not positive definite");
    const double alpha = rz / curvature;
    out.x += alpha * p;
    r -= alpha * Ap;
    ++out.iterations;
    gains.push_back(alpha * rz);
    out.energy += gains.back();
    double last_gains = 0;
    for (int k = 0; k < std::min<int>(kLastGains, out.iterations); ++k)
      last_gains += gains[gains.size() - 1 - static_cast<std::size_t>(k)];
    if (out.iterations > kLastGains && last_gains <= accuracy * out.energy) {
      out.converged = true;
      break;
    }
    z = preconditioned();
    const double next = r.dot(z);
    p = z + (next / rz) * p;
    rz = next;
  }
  return out;
}

}  // namespace orthodyn
