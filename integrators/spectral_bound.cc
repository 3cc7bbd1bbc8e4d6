#include "integrators/spectral_bound.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <random>

namespace orthodyn {

namespace {

constexpr int kMaxIterations = 60;
constexpr int kMinIterations = 20;     // a warm start must have seen more than its own mode
constexpr double kResidual = 0.01;     // of the eigenvalue: half a percent of a frequency
constexpr double kFreshPart = 0.1;     // of a random vector in a warm start
constexpr double kBreakdown = 1e-12;   // of the eigenvalue: the space is invariant

Vector random_vector(int n) {
  std::mt19937 generator(1);
  Vector x(n);
  for (double& value : x) value = static_cast<double>(generator()) / 4294967295.0 - 0.5;
  return x;
}

}  // namespace

// Lanczos vectors V and M V, and the tridiagonal matrix.
struct SpectralBound::Basis {
  explicit Basis(Eigen::Index n, int size) : v(n, size), mv(n, size), diagonal(size), beside(size) {}

  // The largest eigenpair of the leading k x k part.
  std::pair<double, Vector> largest(int k) const {
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes;
    modes.computeFromTridiagonal(diagonal.head(k), beside.head(k - 1));
    return {modes.eigenvalues()[k - 1], modes.eigenvectors().col(k - 1)};
  }

  Eigen::MatrixXd v, mv;
  Vector diagonal, beside;
};

SpectralBound::SpectralBound(const Model& model) : model_(model), random_(random_vector(model.num_dofs())) {}

void SpectralBound::multiply(const double* values, const Vector& x, Vector& y) const {
  const Pattern& pattern = model_.pattern();
  pattern.multiply(values, x, y);
  if (!pattern.symmetric) y = 0.5 * (y + pattern.matrix(values).transpose() * x).eval();
}

Vector SpectralBound::start() const {
  if (!ritz_.size()) return random_;
  return ritz_ / ritz_.norm() + kFreshPart * random_ / random_.norm();
}

double SpectralBound::largest(const double* values) {
  const int n = model_.num_dofs(), most = std::min(n, kMaxIterations);
  Basis basis(n, most);
  Vector w = start(), mw(n), au(n);
  double scale = 0;  // of the eigenvalues met
  for (int k = 0;; ++k) {
    model_.multiply_mass(w, mw);
    const double norm = std::sqrt(std::max(w.dot(mw), 0.0));
    if (k > 0) {
      basis.beside[k - 1] = norm;
      const auto [value, shape] = basis.largest(k);
      scale = std::max(scale, std::abs(value));
      const double residual = norm * std::abs(shape[k - 1]);
      const bool converged = k >= kMinIterations && residual <= kResidual * value;
      if (converged || k == most || norm <= kBreakdown * scale) {
        ritz_ = basis.v.leftCols(k) * shape;
        return std::max(value + residual, 0.0);
      }
    }
    basis.v.col(k) = w / norm;
    basis.mv.col(k) = mw / norm;
    multiply(values, basis.v.col(k), au);
    basis.diagonal[k] = basis.v.col(k).dot(au);
    model_.solve_mass(au);
    w = au;
    for (int pass = 0; pass < 2; ++pass)  // twice is enough: orthogonal to round-off
      w -= basis.v.leftCols(k + 1) * (basis.mv.leftCols(k + 1).transpose() * w).eval();
  }
}

}  // namespace orthodyn
