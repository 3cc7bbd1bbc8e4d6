#include "lib/study/compare/work_precision.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orthodyn::study::compare {

std::optional<double> seconds_to_reach(double target, const std::vector<WorkPoint>& points) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const WorkPoint& tight = points[i];
    if (!(tight.error <= kTargetTolerance * target)) continue;
    best = std::min(best, tight.seconds);
    if (i == 0 || tight.error > target || !(points[i - 1].error > target) || tight.error == 0) continue;
    const WorkPoint& loose = points[i - 1];
    const double part = std::log(loose.error / target) / std::log(loose.error / tight.error);
    best = std::min(best, std::exp(std::lerp(std::log(loose.seconds), std::log(tight.seconds), part)));
  }
  if (!std::isfinite(best)) return std::nullopt;
  return best;
}

std::optional<Slope> slope(const std::vector<WorkPoint>& points) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  Slope fit;
  for (const auto& p : points) {
    if (!p.resolved || !(p.error > 0) || !(p.error < 0.3)) continue;
    const double x = std::log(p.control), y = std::log(p.error);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    if (fit.points++ == 0) fit.from = p.error;
    fit.to = p.error;
  }
  const double spread = n * sxx - sx * sx;
  if (fit.points < 3 || spread <= 0) return std::nullopt;
  fit.value = (n * sxy - sx * sy) / spread;
  return fit;
}

std::vector<double> targets(const std::vector<WorkPoint>& points, double floor) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& p : points) smallest = std::min(smallest, p.error);
  std::vector<double> out;
  for (int exponent = -1; exponent >= -12; --exponent)
    if (const double target = std::pow(10, exponent); kTargetTolerance * target >= smallest && target > floor)
      out.push_back(target);
  return out;
}

}  // namespace orthodyn::study::compare
