#include "lib/linear/unit_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/golden_ratio_sample.h"

namespace orthodyn {

double nearest_power_of_two(double x) { return x > 0 && std::isnormal(x) ? std::exp2(std::round(std::log2(x))) : 1; }

Vector diagonal(const Pattern& pattern, const std::vector<double>& values) {
  Vector d(pattern.n);  // the diagonal is the first entry of each column of the lower triangle
  for (int j = 0; j < pattern.n; ++j)
    d[j] = values[static_cast<std::size_t>(pattern.column_start[static_cast<std::size_t>(j)])];
  return d;
}

Eigen::MatrixXd dense_symmetric(const Pattern& pattern, const std::vector<double>& values) {
  const Eigen::MatrixXd stored(pattern.matrix(values.data()));
  return stored.selfadjointView<Eigen::Lower>();
}

double operator_norm(int n, const VectorFunction& first, const VectorFunction& second) {
  constexpr int kSteps = 3;
  Vector x(n), between(n), image(n);
  for (int i = 0; i < n; ++i) x[i] = golden_ratio_sample(i) - 0.5;  // without any symmetry
  double size = 0;
  for (int k = 0; k < kSteps && x.norm() > 0; ++k) {
    x.normalize();
    first(x, between);
    second(between, image);
    size = std::max(size, image.norm());
    x = image;
  }
  return std::max(size, std::numeric_limits<double>::min());
}

}  // namespace orthodyn
