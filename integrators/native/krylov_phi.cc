#include "integrators/native/krylov_phi.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr double kInvariant = 1e-14;  // relative to |J v|; below it the space is invariant
constexpr int kFirstCheck = 4;

// Dimension of the next error check. The checks are spaced so that the small exponentials cost less than the space.
int next_check(int dimension) { return std::max(kFirstCheck, dimension + std::max(2, dimension / 4)); }

}  // namespace

KrylovPhi::KrylovPhi(Eigen::Index size, int max_dimension)
    : max_dimension_(static_cast<int>(std::min<Eigen::Index>(size, max_dimension))),
      basis_(size, max_dimension_ + 1),
      hessenberg_(max_dimension_ + 1, max_dimension_) {}

void KrylovPhi::begin(const Operator& J, const Vector& b) {
  J_ = J;
  dimension_ = 0;
  hessenberg_.setZero();
  beta_ = b.norm();
  invariant_ = beta_ == 0;
  if (!invariant_) basis_.col(0) = b / beta_;
}

void KrylovPhi::grow() {
  const int m = dimension_++;
  auto w = basis_.col(m + 1);
  J_(basis_.col(m), w);
  const double size = w.norm();
  for (int pass = 0; pass < 2; ++pass) {  // twice is enough: orthogonal to round-off
    const Vector share = basis_.leftCols(m + 1).transpose() * w;
    w -= basis_.leftCols(m + 1) * share;
    hessenberg_.col(m).head(m + 1) += share;
  }
  const double eta = w.norm();
  if (!std::isfinite(eta)) throw RecoverableError("the tangent is not finite");
  invariant_ = eta <= kInvariant * size;
  hessenberg_(m + 1, m) = invariant_ ? 0 : eta;
  if (!invariant_) w /= eta;
}

bool KrylovPhi::apply(int k, double h, double tolerance, Vector& out) {
  const double root_size = std::sqrt(static_cast<double>(basis_.rows()));
  if (beta_ == 0) {
    out.setZero(basis_.rows());
    return true;
  }
  for (int check = std::max(dimension_, kFirstCheck);; check = next_check(check)) {
    while (dimension_ < std::min(check, max_dimension_) && !invariant_) grow();
    const int m = dimension_;
    const Eigen::MatrixXd phi = small_phi(h, k + 1);
    const double last = invariant_ ? 0 : beta_ * h * hessenberg_(m, m - 1) * phi(m - 1, k);
    if (std::abs(last) <= tolerance * root_size) {
      out = beta_ * (basis_.leftCols(m) * phi.col(k - 1));
      if (!invariant_) out += last * basis_.col(m);
      return true;
    }
    if (invariant_ || m == max_dimension_) return false;
  }
}

Eigen::MatrixXd KrylovPhi::small_phi(double h, int count) const {
  const int m = dimension_;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(m + count, m + count);
  A.topLeftCorner(m, m) = h * hessenberg_.topLeftCorner(m, m);
  A(0, m) = 1;
  for (int j = 0; j + 1 < count; ++j) A(m + j, m + j + 1) = 1;
  const Eigen::MatrixXd E = A.exp();
  return E.topRightCorner(m, count);
}

}  // namespace orthodyn
