#include "lib/study/converge/richardson.h"

#include <algorithm>
#include <cmath>

namespace orthodyn::study::converge {

namespace {

constexpr double kSafe = 1.25, kUnsafe = 3;  // Roache's factors with and without an observed order

constexpr double kLowest = 0.5, kAssumed = 1;        // orders

// Of three values, where the second step is the smaller one and in the same direction.
std::optional<double> observed_order(double coarse, double middle, double fine, double ratio) {
  const double quotient = (middle - coarse) / (fine - middle);
  if (!(quotient > 1)) return std::nullopt;
  return std::log(quotient) / std::log(ratio);
}

}  // namespace

std::optional<Extrapolation> extrapolate(const std::vector<double>& values, double ratio, double highest) {
  const std::size_t n = values.size();
  if (n < 2) return std::nullopt;
  const double fine = values[n - 1], step = fine - values[n - 2];
  Extrapolation out;
  if (n >= 3) out.order = observed_order(values[n - 3], values[n - 2], fine, ratio);
  const bool observed = out.order && *out.order >= kLowest;
  const double order = observed ? std::min(*out.order, highest) : kAssumed;
  const double correction = step / (std::pow(ratio, order) - 1);
  out.limit = fine + correction;
  out.uncertainty = (observed ? kSafe : kUnsafe) * std::abs(correction);
  return out;
}

}  // namespace orthodyn::study::converge
