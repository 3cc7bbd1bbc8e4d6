#include "integrators/spectral_bound.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "integrators/random_vector.h"

namespace orthodyn {

namespace {

constexpr int kMaxIterations = 60;
constexpr int kMinIterations = 20;    // a warm start must find more than the mode it starts from
constexpr double kResidual = 0.01;    // relative to the eigenvalue: half a percent of a frequency
constexpr double kFreshPart = 0.1;    // share of a random vector in a warm start
constexpr double kBreakdown = 1e-12;  // relative to the eigenvalue; below it the space is invariant

}  // namespace

// The tridiagonal matrix, and the Lanczos vectors in single precision for the start vector of the next call.
struct SpectralBound::Basis {
  explicit Basis(int size) : diagonal(size), off_diagonal(size) {}

  // The largest eigenpair of the leading k x k part.
  std::pair<double, Vector> largest(int k) const {
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes;
    modes.computeFromTridiagonal(diagonal.head(k), off_diagonal.head(k - 1));
    return {modes.eigenvalues()[k - 1], modes.eigenvectors().col(k - 1)};
  }
  Vector combined(const Vector& shape) const {
    Vector sum = Vector::Zero(v.front().size());
    for (std::size_t k = 0; k < v.size(); ++k) sum += shape[static_cast<Eigen::Index>(k)] * v[k].cast<double>();
    return sum;
  }

  std::vector<Eigen::VectorXf> v;
  Vector diagonal, off_diagonal;
};

SpectralBound::SpectralBound(const Model& model) : model_(model), random_(random_vector(model)) {}

void SpectralBound::multiply(const double* values, const Vector& x, Vector& y) const {
  const Pattern& pattern = model_.pattern();
  model_.multiply_matrix(values, x, y);
  if (!pattern.symmetric) y = 0.5 * (y + pattern.matrix(values).transpose() * x).eval();
}

Vector SpectralBound::start() const {
  if (!is_warm_) return random_;
  const VectorSpace space = model_.space();
  return ritz_ / space.norm(ritz_) + kFreshPart * random_ / space.norm(random_);
}

// Each vector is orthogonalised only against the previous two; against all of them, it would take more time and memory
// than the matrix. Orthogonality to the others persists until an eigenvalue has converged to half of the digits (Paige
// 1971). If that happens before kMinIterations, copies of the eigenvalue appear. They do not exceed it, so the bound
// remains valid.
double SpectralBound::largest(const double* values) {
  const VectorSpace space = model_.space();
  const int n = model_.num_dofs();
  const int most = static_cast<int>(std::min<Eigen::Index>(model_.num_dofs_of_all(), kMaxIterations));
  Basis basis(most);
  Vector w = start(), v = Vector::Zero(n), before(n), mw(n), av(n);
  double scale = 0;  // largest eigenvalue so far
  for (int k = 0;; ++k) {
    model_.multiply_mass(w, mw);
    const double norm = std::sqrt(std::max(space.dot(w, mw), 0.0));
    if (k > 0) {
      basis.off_diagonal[k - 1] = norm;
      const auto [value, shape] = basis.largest(k);
      scale = std::max(scale, std::abs(value));
      const double residual = norm * std::abs(shape[k - 1]);
      const bool converged = k >= kMinIterations && residual <= kResidual * value;
      if (converged || k == most || norm <= kBreakdown * scale) {
        ritz_ = basis.combined(shape);
        is_warm_ = true;
        return std::max(value + residual, 0.0);
      }
    }
    before.swap(v);
    v = w / norm;
    basis.v.push_back(v.cast<float>());
    multiply(values, v, av);
    basis.diagonal[k] = space.dot(v, av);
    model_.solve_mass(av);
    w = av - basis.diagonal[k] * v - norm * before;  // `before` is 0 at k = 0
  }
}

}  // namespace orthodyn
