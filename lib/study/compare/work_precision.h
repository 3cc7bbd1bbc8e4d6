// What the points of a comparison say: how long each method takes to reach an error, and how its error falls.
#pragma once

#include <optional>
#include <vector>

namespace orthodyn::study::compare {

// One finished point of a method.
struct WorkPoint {
  double control = 0;  // rtol, or step in s
  double error = 0;
  double seconds = 0;
  bool resolved = true;  // its error is well above that of the reference
};

// A point whose error is above a target by a twentieth at most has reached it: errors are hardly known better.
inline constexpr double kAsGood = 1.05;

// Seconds to reach an error, from loose to tight points, by log-log interpolation between neighbours;
// nothing if no point reaches it.
std::optional<double> seconds_to_reach(double target, const std::vector<WorkPoint>& points);

struct Slope {
  double value = 0;
  int points = 0;
  double from = 0, to = 0;  // the errors at its ends
};

// Least squares of log error over log control, of the resolved points with an error below 30 %; nothing
// for fewer than three.
std::optional<Slope> slope(const std::vector<WorkPoint>& points);

// Powers of ten, large to small, that at least one of the points reaches and that are above `floor`.
std::vector<double> targets(const std::vector<WorkPoint>& points, double floor);

}  // namespace orthodyn::study::compare
