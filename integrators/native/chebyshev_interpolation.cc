#include "integrators/native/chebyshev_interpolation.h"

#include <cmath>
#include <numbers>

namespace orthodyn {
namespace {

using LoadMatrix = Eigen::Matrix<double, kLoadTerms, kLoadTerms>;

std::array<double, kLoadTerms> make_chebyshev_points() {
  std::array<double, kLoadTerms> points{};
  for (std::size_t j = 0; j < kLoadTerms; ++j)
    points[j] = (1 - std::cos((2 * static_cast<double>(j) + 1) * std::numbers::pi / (2 * kLoadTerms))) / 2;
  return points;
}

// A row of values at the points times this matrix gives the row of coefficients.
LoadMatrix values_to_coefficients() {
  LoadMatrix powers;  // row k: k-th powers of the points
  for (int k = 0; k < kLoadTerms; ++k)
    for (int j = 0; j < kLoadTerms; ++j) powers(k, j) = std::pow(chebyshev_points()[static_cast<std::size_t>(j)], k);
  return powers.fullPivLu().inverse();
}

// Derivative of the given order, 0 to 2.
Vector derivative(const Eigen::MatrixXd& coefficients, double theta, int order) {
  Vector weights = Vector::Zero(kLoadTerms);
  for (int k = order; k < kLoadTerms; ++k) {
    double factor = 1;
    for (int j = 0; j < order; ++j) factor *= k - j;
    weights[k] = factor * std::pow(theta, k - order);
  }
  return coefficients * weights;
}

}  // namespace

const std::array<double, kLoadTerms>& chebyshev_points() {
  static const auto points = make_chebyshev_points();
  return points;
}

Eigen::MatrixXd polynomial_coefficients(const Eigen::MatrixXd& values) {
  static const LoadMatrix transform = values_to_coefficients();
  Eigen::MatrixXd coefficients = (values.colwise() - values.col(0)) * transform;
  coefficients.col(0) += values.col(0);
  return coefficients;
}

Vector polynomial_value(const Eigen::MatrixXd& c, double theta) { return derivative(c, theta, 0); }
Vector polynomial_slope(const Eigen::MatrixXd& c, double theta) { return derivative(c, theta, 1); }
Vector polynomial_curvature(const Eigen::MatrixXd& c, double theta) { return derivative(c, theta, 2); }

}  // namespace orthodyn
