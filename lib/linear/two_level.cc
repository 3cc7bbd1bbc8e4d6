#include "lib/linear/two_level.h"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <utility>

namespace orthodyn {

class TwoLevelSolver::Smoother {
 public:
  explicit Smoother(const Eigen::Map<const SparseMatrix>& A) { factor_.compute(SparseMatrix(A)); }
  Vector operator()(const Vector& r) const { return factor_.solve(r); }
  bool ok() const { return factor_.info() == Eigen::Success; }

 private:
  Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
};

TwoLevelSolver::TwoLevelSolver(const Pattern& pattern, const std::vector<double>& values, CoarseSolution coarse)
    : pattern_(pattern),
      values_(values),
      coarse_(std::move(coarse)),
      smoother_(std::make_unique<Smoother>(pattern.matrix(values.data()))) {
  if (!smoother_->ok()) throw IndefiniteMatrix("the matrix has no incomplete factor");
}

TwoLevelSolver::~TwoLevelSolver() = default;

TwoLevelSolver::Solution TwoLevelSolver::solve(const ConstVectorRef& b, double accuracy, int max_iterations) const {
  constexpr int kLastGains = 4;  // iterations whose gains are compared with the energy
  Solution out{Vector::Zero(b.size())};
  Vector r = b, Ap(b.size());
  const auto preconditioned = [&] { return Vector((*smoother_)(r) + coarse_(r)); };
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
