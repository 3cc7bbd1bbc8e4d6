#include "lib/linear/two_level.h"

#include <algorithm>
#include <array>
#include <utility>

namespace orthodyn {

namespace {

constexpr Eigen::Index kTogether = 4;  // right-hand sides that are solved together
constexpr int kLastGains = 4;          // iterations whose gains are compared with the energy

// One column per right-hand side.
template <int kColumns>
using Columns = Eigen::Array<double, Eigen::Dynamic, kColumns, kColumns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
template <int kColumns>
using OneRow = Eigen::Array<double, 1, kColumns>;

}  // namespace

// A = L + D + L^T, given by its lower triangle.
class TwoLevelSolver::LowerTriangle {
 public:
  LowerTriangle(const Pattern& pattern, const std::vector<double>& values, const Vector& diagonal)
      : n_(pattern.n),
        start_(pattern.column_start.data()),
        row_(pattern.row.data()),
        values_(values.data()),
        diagonal_(diagonal.data()) {}

  // Sets y = A x.
  template <int kColumns>
  void multiply(const Columns<kColumns>& x, Columns<kColumns>& y) const {
    y.setZero();
    for (int j = 0; j < n_; ++j) {
      const OneRow<kColumns> x_j = x.row(j);
      OneRow<kColumns> sum = diagonal_[j] * x_j;
      for (int e = start_[j] + 1, end = start_[j + 1]; e < end; ++e) {
        sum += values_[e] * x.row(row_[e]);
        y.row(row_[e]) += values_[e] * x_j;
      }
      y.row(j) += sum;
    }
  }

  // Sets z = (D + L)^-T D (D + L)^-1 r, a symmetric sweep.
  template <int kColumns>
  void smooth(const Columns<kColumns>& r, Columns<kColumns>& z) const {
    z = r;
    for (int j = 0; j < n_; ++j) {
      const OneRow<kColumns> z_j = z.row(j) / diagonal_[j];
      z.row(j) = z_j;
      for (int e = start_[j] + 1, end = start_[j + 1]; e < end; ++e) z.row(row_[e]) -= values_[e] * z_j;
    }
    for (int j = n_ - 1; j >= 0; --j) {
      OneRow<kColumns> sum = OneRow<kColumns>::Zero();
      for (int e = start_[j] + 1, end = start_[j + 1]; e < end; ++e) sum += values_[e] * z.row(row_[e]);
      z.row(j) -= sum / diagonal_[j];
    }
  }

 private:
  int n_;
  const int *start_, *row_;
  const double *values_, *diagonal_;
};

TwoLevelSolver::TwoLevelSolver(const Pattern& pattern, const std::vector<double>& values, CoarseSolution coarse)
    : pattern_(pattern), values_(values), coarse_(std::move(coarse)), diagonal_(pattern.n) {
  for (int j = 0; j < pattern.n; ++j)  // the first entry of a column of the lower triangle
    diagonal_[j] = values[static_cast<std::size_t>(pattern.column_start[static_cast<std::size_t>(j)])];
  if (!(diagonal_.array() > 0).all()) throw IndefiniteMatrix("the matrix has a diagonal entry that is not positive");
}

// A column that has converged keeps its x, while the others continue.
template <int kColumns>
void TwoLevelSolver::solve_group(const Eigen::Ref<const Eigen::MatrixXd>& b, double accuracy, int max_iterations,
                                 std::vector<Solution>& out) const {
  using Group = Columns<kColumns>;
  const LowerTriangle A(pattern_, values_, diagonal_);
  const Eigen::Index given = b.cols();  // a group may have fewer than kColumns; the others are zero
  std::array<Solution, kColumns> found;
  std::array<std::vector<double>, kColumns> gains;
  Group r = Group::Zero(b.rows(), kColumns), x = r, Ap(b.rows(), kColumns), z = Ap, p;
  r.leftCols(given) = b.array();
  const auto precondition = [&] {
    A.smooth<kColumns>(r, z);
    for (Eigen::Index c = 0; c < given; ++c) z.col(c) += coarse_(r.col(c).matrix()).array();
  };
  precondition();
  p = z;
  OneRow<kColumns> rz = (r * z).colwise().sum(), alpha, beta;
  const auto is_active = [&](Eigen::Index c) { return !found[static_cast<std::size_t>(c)].converged && rz[c] > 0; };
  const auto any_active = [&] {
    for (Eigen::Index c = 0; c < given; ++c)
      if (is_active(c)) return true;
    return false;
  };
  for (int k = 0; k < max_iterations && any_active(); ++k) {
    A.multiply<kColumns>(p, Ap);
    const OneRow<kColumns> curvature = (p * Ap).colwise().sum();
    alpha.setZero();
    for (Eigen::Index c = 0; c < given; ++c) {
      if (!is_active(c)) continue;
      if (!(curvature[c] > 0)) throw IndefiniteMatrix("the matrix is not positive definite");
      alpha[c] = rz[c] / curvature[c];
      Solution& one = found[static_cast<std::size_t>(c)];
      auto& gained = gains[static_cast<std::size_t>(c)];
      ++one.iterations;
      gained.push_back(alpha[c] * rz[c]);
      one.energy += gained.back();
      double last_gains = 0;
      for (int i = 0; i < std::min(kLastGains, one.iterations); ++i)
        last_gains += gained[gained.size() - 1 - static_cast<std::size_t>(i)];
      one.converged = one.iterations > kLastGains && last_gains <= accuracy * one.energy;
    }
    x += p.rowwise() * alpha;
    r -= Ap.rowwise() * alpha;
    if (!any_active()) break;
    precondition();
    const OneRow<kColumns> next = (r * z).colwise().sum();
    for (Eigen::Index c = 0; c < kColumns; ++c) beta[c] = rz[c] > 0 ? next[c] / rz[c] : 0;
    p = p.rowwise() * beta + z;
    rz = next;
  }
  for (Eigen::Index c = 0; c < given; ++c) {
    found[static_cast<std::size_t>(c)].x = x.col(c);
    out.push_back(std::move(found[static_cast<std::size_t>(c)]));
  }
}

std::vector<TwoLevelSolver::Solution> TwoLevelSolver::solve(const Eigen::MatrixXd& b, double accuracy,
                                                            int max_iterations) const {
  std::vector<Solution> out;
  for (Eigen::Index first = 0; first < b.cols(); first += kTogether) {
    const auto group = b.middleCols(first, std::min(kTogether, b.cols() - first));
    if (group.cols() == 1) solve_group<1>(group, accuracy, max_iterations, out);
    else solve_group<kTogether>(group, accuracy, max_iterations, out);
  }
  return out;
}

}  // namespace orthodyn
