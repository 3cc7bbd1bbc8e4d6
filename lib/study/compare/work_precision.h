// Evaluation of work-precision points: time to reach an error, and observed order.
#pragma once

#include <optional>
#include <vector>

namespace orthodyn::study::compare {

// One finished point of a method.
struct WorkPoint {
  double control = 0;  // rtol, step (s) or safety
  double error = 0;
  double seconds = 0;
  bool resolved = true;  // the error is well above that of the reference
};

// An error up to 5 % above a target counts as reaching it, because errors are hardly known more precisely.
inline constexpr double kTargetTolerance = 1.05;

// Time (s) to reach the error `target`, by log-log interpolation between neighbouring points; empty if no point reaches
// it. `points` are ordered from loose to tight.
std::optional<double> seconds_to_reach(double target, const std::vector<WorkPoint>& points);

struct Slope {
  double value = 0;         // exponent p of error ~ control^p
  int points = 0;           // number of points used
  double from = 0, to = 0;  // errors of the first and last point used
};

// Least squares fit of log error over log control, through the resolved points with an error between 0 and 30 %; empty
// for fewer than three such points.
std::optional<Slope> slope(const std::vector<WorkPoint>& points);

// The powers of ten from 1e-1 down to 1e-12 that exceed `floor` and that at least one point reaches.
std::vector<double> targets(const std::vector<WorkPoint>& points, double floor);

}  // namespace orthodyn::study::compare
