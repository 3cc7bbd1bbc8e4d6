#include "lib/fem/differences.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace orthodyn {

DifferenceWeights::DifferenceWeights(double x) {
  // c[m][k]: weight of point k in the m-th derivative, using points 0..n (Fornberg's recursion).
  std::array<std::array<double, kPoints>, 3> c{};
  c[0][0] = 1;
  double c1 = 1;
  for (std::size_t n = 1; n < kPoints; ++n) {
    const double to_new = static_cast<double>(n) - x, to_last = to_new - 1;
    double c2 = 1;
    for (std::size_t k = 0; k < n; ++k) {
      const double c3 = static_cast<double>(n - k);
      c2 *= c3;
      if (k + 1 == n)
        for (std::size_t m = std::min<std::size_t>(n, 2) + 1; m-- > 0;)
          c[m][n] = c1 / c2 * ((m > 0 ? static_cast<double>(m) * c[m - 1][n - 1] : 0) - to_last * c[m][n - 1]);
      for (std::size_t m = std::min<std::size_t>(n, 2) + 1; m-- > 0;)
        c[m][k] = (to_new * c[m][k] - (m > 0 ? static_cast<double>(m) * c[m - 1][k] : 0)) / c3;
    }
    c1 = c2;
  }
  first = c[1];
  second = c[2];
}

// The function is close to a cubic over each part of the step limits, so a part covers about a third of a period.
DifferenceStep::DifferenceStep(StepLimits limits, double start, double end)
    : longest_(end > start ? (end - start) / 1000 : 1), limits_(std::move(limits)) {}

double DifferenceStep::at(double t) const {
  constexpr double kStepsToAPart = 32, kReach = (DifferenceWeights::kPoints - 1) / 2.0;
  double step = longest_;
  for (double begin = t - kReach * step; limits_.latest_end(begin) - begin < kStepsToAPart * step;
       begin = t - kReach * step)
    step /= 2;
  return step;
}

SmoothStretch::SmoothStretch(double t, double step, const std::vector<double>& kinks) {
  constexpr double kIntervals = DifferenceWeights::kPoints - 1;
  double from = -std::numeric_limits<double>::infinity(), to = -from;
  for (const double kink : kinks) {
    if (kink <= t) from = std::max(from, kink);
    else to = std::min(to, kink);
  }
  const double length = std::min(kIntervals * step, to - from);
  begin = std::max(from, std::min(t - length / 2, to - length));
  h = length / kIntervals;
}

}  // namespace orthodyn
