#include "lib/study/compare/pareto_front.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "lib/study/compare/work_precision.h"

namespace orthodyn::study::compare {

std::vector<CostPoint> pareto_front(std::vector<CostPoint> points, double floor) {
  std::sort(points.begin(), points.end(), [](const CostPoint& a, const CostPoint& b) {
    return std::tie(a.seconds, a.error) < std::tie(b.seconds, b.error);
  });
  std::vector<CostPoint> out;
  double best = std::numeric_limits<double>::infinity();
  for (const auto& point : points) {
    const double error = std::max(point.error, floor);
    if (!(error < best)) continue;
    best = error;
    out.push_back(point);
  }
  return out;
}

std::optional<CostPoint> fastest(const std::vector<CostPoint>& points, double target) {
  std::optional<CostPoint> best;
  for (const auto& point : points)
    if (point.error <= kAsGood * target && (!best || point.seconds < best->seconds)) best = point;
  return best;
}

}  // namespace orthodyn::study::compare
