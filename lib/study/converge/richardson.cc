#include "lib/study/converge/richardson.h"

#include <algorithm>
#include <cmath>

namespace orthodyn::study::converge {

namespace {

constexpr double kSafe = 1.25;   // Roache's factor with an observed order
constexpr double kLowest = 0.5;  // order
constexpr double kSame = 1e-9;   // relative: values of solvers' round-off

// Of three values, where the second step is the smaller one and in the same direction.
std::optional<double> observed_order(double coarse, double middle, double fine, double ratio) {
  const double quotient = (middle - coarse) / (fine - middle);
  if (!(quotient > 1)) return std::nullopt;
  return std::log(quotient) / std::log(ratio);
}

}  // namespace

std::optional<Extrapolation> extrapolate(const std::vector<double>& values, double ratio, double highest) {
  const std::size_t n = values.size();
  if (n < 3) return std::nullopt;
  const double coarse = values[n - 3], middle = values[n - 2], fine = values[n - 1];
  const double spread = std::max({coarse, middle, fine}) - std::min({coarse, middle, fine});
  if (spread <= kSame * std::abs(fine)) return Extrapolation{fine, spread, std::nullopt};
  const auto order = observed_order(coarse, middle, fine, ratio);
  if (!order || *order < kLowest) return std::nullopt;
  const double correction = (fine - middle) / (std::pow(ratio, std::min(*order, highest)) - 1);
  return Extrapolation{fine + correction, kSafe * std::abs(correction), order};
}

}  // namespace orthodyn::study::converge
