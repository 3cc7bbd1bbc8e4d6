#include "lib/study/sweep/latin_hypercube.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>

namespace orthodyn {

namespace {

// Not std::uniform_real_distribution, whose results differ between standard libraries.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

}  // namespace

double position_in(std::size_t stratum, double u, std::size_t strata) {
  return std::min((static_cast<double>(stratum) + u) / static_cast<double>(strata), std::nextafter(1.0, 0.0));
}

std::vector<std::vector<double>> latin_hypercube(int points, int dimensions, long seed) {
  const auto n = static_cast<std::size_t>(points), d = static_cast<std::size_t>(dimensions);
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::vector<std::vector<double>> out(n, std::vector<double>(d));
  std::vector<std::size_t> strata(n);
  for (std::size_t k = 0; k < d; ++k) {
    std::iota(strata.begin(), strata.end(), 0u);
    for (std::size_t i = n; i > 1; --i)
      std::swap(strata[i - 1], strata[static_cast<std::size_t>(uniform(random) * static_cast<double>(i))]);
    for (std::size_t i = 0; i < n; ++i) out[i][k] = position_in(strata[i], uniform(random), n);
  }
  return out;
}

}  // namespace orthodyn
