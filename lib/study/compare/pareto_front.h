// What no other point beats in both error and time: the front of a set of points (Pareto).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace orthodyn::study::compare {

struct CostPoint {
  std::size_t index = 0;
  double seconds = 0, error = 0;
};

// From fast to accurate. Errors below `floor` are not told apart: of those points the fastest stands for all.
std::vector<CostPoint> pareto_front(std::vector<CostPoint> points, double floor);

// The fastest with an error of at most `target`.
std::optional<CostPoint> fastest(const std::vector<CostPoint>& points, double target);

}  // namespace orthodyn::study::compare
