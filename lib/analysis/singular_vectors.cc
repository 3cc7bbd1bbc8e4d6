#include "lib/analysis/singular_vectors.h"

#include <cmath>

namespace orthodyn {

namespace {

constexpr double kOrthogonal = 1e-13;  // largest cosine of orthogonal columns; just above round-off
constexpr int kMostSweeps = 60;        // about six are needed

void rotate(Eigen::MatrixXd& A, Eigen::Index i, Eigen::Index j, double cosine, double sine) {
  const Vector a = A.col(i);
  A.col(i) = cosine * a - sine * A.col(j);
  A.col(j) = sine * a + cosine * A.col(j);
}

// Makes columns i and j orthogonal; false if they already are.
bool orthogonalize(Eigen::MatrixXd& A, Eigen::MatrixXd& V, Eigen::Index i, Eigen::Index j) {
  const double a = A.col(i).squaredNorm(), b = A.col(j).squaredNorm(), c = A.col(i).dot(A.col(j));
  if (std::abs(c) <= kOrthogonal * std::sqrt(a) * std::sqrt(b)) return false;
  const double zeta = (b - a) / (2 * c);
  const double tangent = std::copysign(1 / (std::abs(zeta) + std::hypot(1, zeta)), zeta);
  const double cosine = 1 / std::hypot(1, tangent);
  rotate(A, i, j, cosine, cosine * tangent);
  rotate(V, i, j, cosine, cosine * tangent);
  return true;
}

}  // namespace

SingularVectors right_singular_vectors(Eigen::MatrixXd A) {
  Eigen::MatrixXd V = Eigen::MatrixXd::Identity(A.cols(), A.cols());
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < kMostSweeps; ++sweep) {
    rotated = false;
    for (Eigen::Index i = 0; i < A.cols(); ++i)
      for (Eigen::Index j = i + 1; j < A.cols(); ++j) rotated |= orthogonalize(A, V, i, j);
  }
  return {A.colwise().norm(), std::move(V)};
}

}  // namespace orthodyn
