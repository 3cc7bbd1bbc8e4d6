// Monotone piecewise cubic interpolation: smooth up to the first derivative, monotone between points where the data
// are, and exact for linear data. Slopes by Fritsch & Butland (1984, SIAM J. Sci. Stat. Comput. 5), the weighted
// harmonic means of the secants, which satisfy the conditions of Fritsch & Carlson (1980, SIAM J. Numer. Anal. 17); at
// the ends, limited three-point formulas. Beyond the ends, the function is linear with given slopes.
#pragma once

#include <array>
#include <vector>

namespace orthodyn {

class MonotoneCubic {
 public:
  using Point = std::array<double, 2>;  // (x, y)
  enum class Ends { constant, with_end_slopes };

  // No points: the function is zero.
  MonotoneCubic() = default;
  // Precondition: at least two points, x ascending.
  MonotoneCubic(const std::vector<Point>& points, Ends left, Ends right);

  double value(double x) const;
  double slope(double x) const;  // right-hand value at a kink
  // The integral from a to b (b < a is allowed), exact to round-off, without cancellation for b near a.
  double integral(double a, double b) const;
  double largest_slope() const;  // largest |slope|

 private:
  std::size_t piece(double x) const;  // 0: before the first knot, x_.size(): after the last one
  double value_on(std::size_t piece, double x) const;

  std::vector<double> x_, y_, d_;  // knots, values and slopes
  double left_ = 0, right_ = 0;    // slopes outside
};

}  // namespace orthodyn
