#include "lib/material/fibres/monotone_cubic.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

namespace {

// The slope at an end from the two nearest pieces of lengths h0, h1 and secants s0, s1, limited so that the
// interpolant stays monotone.
double end_slope(double h0, double h1, double s0, double s1) {
  const double d = ((2 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
  if (d * s0 <= 0) return 0;
  return std::abs(d) > 3 * std::abs(s0) ? 3 * s0 : d;
}

// The slope between two pieces.
double inner_slope(double h0, double h1, double s0, double s1) {
  if (s0 * s1 <= 0) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / s0 + w1 / s1);
}

}  // namespace

MonotoneCubic::MonotoneCubic(const std::vector<Point>& points, Ends left, Ends right) {
  for (const auto& [x, y] : points) {
    x_.push_back(x);
    y_.push_back(y);
  }
  const std::size_t n = x_.size();
  const auto length = [&](std::size_t i) { return x_[i + 1] - x_[i]; };
  const auto secant = [&](std::size_t i) { return (y_[i + 1] - y_[i]) / length(i); };
  if (n == 2) {
    d_.assign(2, secant(0));
  } else {
    d_.push_back(end_slope(length(0), length(1), secant(0), secant(1)));
    for (std::size_t i = 1; i + 1 < n; ++i)
      d_.push_back(inner_slope(length(i - 1), length(i), secant(i - 1), secant(i)));
    d_.push_back(end_slope(length(n - 2), length(n - 3), secant(n - 2), secant(n - 3)));
  }
  if (left == Ends::with_end_slopes) left_ = d_.front();
  if (right == Ends::with_end_slopes) right_ = d_.back();
}

std::size_t MonotoneCubic::piece(double x) const {
  return static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin());
}

double MonotoneCubic::value_on(std::size_t piece, double x) const {
  if (piece == 0) return y_.front() + left_ * (x - x_.front());
  if (piece == x_.size()) return y_.back() + right_ * (x - x_.back());
  const std::size_t i = piece - 1;
  const double h = x_[piece] - x_[i], s = (x - x_[i]) / h, r = 1 - s;
  return r * r * (1 + 2 * s) * y_[i] + s * s * (1 + 2 * r) * y_[piece] + h * s * r * (r * d_[i] - s * d_[piece]);
}

double MonotoneCubic::value(double x) const { return x_.empty() ? 0 : value_on(piece(x), x); }

double MonotoneCubic::slope(double x) const {
  if (x_.empty()) return 0;
  const std::size_t k = piece(x);
  if (k == 0) return left_;
  if (k == x_.size()) return right_;
  const std::size_t i = k - 1;
  const double h = x_[k] - x_[i], s = (x - x_[i]) / h, r = 1 - s;
  return 6 * s * r * (y_[k] - y_[i]) / h + r * (1 - 3 * s) * d_[i] + s * (1 - 3 * r) * d_[k];
}

// Simpson's rule is exact for each cubic.
double MonotoneCubic::integral(double a, double b) const {
  if (b < a) return -integral(b, a);
  if (x_.empty()) return 0;
  double sum = 0;
  for (std::size_t k = piece(a); a < b; ++k) {
    const double end = k < x_.size() ? std::min(b, x_[k]) : b;
    sum += (end - a) / 6 * (value_on(k, a) + 4 * value_on(k, 0.5 * (a + end)) + value_on(k, end));
    a = end;
  }
  return sum;
}

double MonotoneCubic::largest_slope() const {
  double largest = std::max(std::abs(left_), std::abs(right_));
  for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
    // The slope is a parabola of s with these coefficients: c + b s + a s^2.
    const double h = x_[i + 1] - x_[i], secant = (y_[i + 1] - y_[i]) / h;
    const double c = d_[i], b = 6 * secant - 4 * d_[i] - 2 * d_[i + 1], a = 3 * (d_[i] + d_[i + 1]) - 6 * secant;
    largest = std::max({largest, std::abs(d_[i]), std::abs(d_[i + 1])});
    if (a != 0)
      if (const double s = -b / (2 * a); s > 0 && s < 1) largest = std::max(largest, std::abs(c + s * (b + s * a)));
  }
  return largest;
}

}  // namespace orthodyn
