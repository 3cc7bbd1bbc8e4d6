#include "lib/linear/unit_scale.h"

#include <Spectra/Util/SimpleRandom.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace orthodyn {

double nearest_power_of_two(double x) { return x > 0 && std::isnormal(x) ? std::exp2(std::round(std::log2(x))) : 1; }

Vector diagonal(const Pattern& pattern, const std::vector<double>& values) {
  Vector d(pattern.n);  // the first entry of each lower triangle's column
  for (int j = 0; j < pattern.n; ++j)
    d[j] = values[static_cast<std::size_t>(pattern.column_start[static_cast<std::size_t>(j)])];
  return d;
}

double operator_size(int n, const VectorFunction& first, const VectorFunction& second) {
  constexpr int kSteps = 3;
  Vector x = Spectra::SimpleRandom<double>(0).random_vec(n), between(n), image(n);
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
