#include "lib/linear/two_level.h"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <utility>

namespace orthodyn {

namespace {

constexpr int kLook = 4;  // iterations whose gain is compared with what there is

}  // namespace

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

TwoLevelSolver::Solution TwoLevelSolver::solve(const ConstVectorRef& b, double accuracy, int most) const {
  Solution out{Vector::Zero(b.size())};
  Vector r = b, Ap(b.size());
  const auto preconditioned = [&] { return Vector((*smoother_)(r) + coarse_(r)); };
  Vector z = preconditioned(), p = z;
  double rz = r.dot(z);
  std::vector<double> gains;
  while (out.iterations < most && rz > 0) {
    pattern_.multiply(values_.data(), p, Ap);
    const double curvature = p.dot(Ap);
    if (!(curvature > 0)) throw IndefiniteMatrix("the matrix is not positive definite");
    const double alpha = rz / curvature;
    out.x += alpha * p;
    r -= alpha * Ap;
    ++out.iterations;
    gains.push_back(alpha * rz);
    out.energy += gains.back();
    double late = 0;
    for (int k = 0; k < std::min<int>(kLook, out.iterations); ++k)
      late += gains[gains.size() - 1 - static_cast<std::size_t>(k)];
    if (out.iterations > kLook && late <= accuracy * out.energy) {
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
