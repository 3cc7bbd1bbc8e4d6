#include "lib/study/converge/richardson.h"

#include <algorithm>
#include <cmath>

namespace orthodyn::study::converge {

namespace {

constexpr double kSafetyFactor = 1.25;  // Roache's, for an observed order
constexpr double kLowestOrder = 0.5;
constexpr double kRoundOff = 1e-9;  // relative difference of equal values
// Largest range of oscillating values with a limit, relative to the value: with decreasing differences, and with
// others.
constexpr double kOscillation = 0.05, kGrowingOscillation = 0.01;

// Empty unless the second step is smaller than the first and has the same sign.
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
  const bool calms = std::abs(fine - middle) < std::abs(middle - coarse);
  const bool oscillates = (middle - coarse) * (fine - middle) < 0 &&
                          spread <= (calms ? kOscillation : kGrowingOscillation) * std::abs(fine);
  if (oscillates || spread <= kRoundOff * std::abs(fine)) return Extrapolation{fine, spread, std::nullopt};
  const auto order = observed_order(coarse, middle, fine, ratio);
  if (!order || *order < kLowestOrder) return std::nullopt;
  const double correction = (fine - middle) / (std::pow(ratio, std::min(*order, highest)) - 1);
  return Extrapolation{fine + correction, kSafetyFactor * std::abs(correction), order};
}

}  // namespace orthodyn::study::converge
