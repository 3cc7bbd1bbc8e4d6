// First and second time derivative of a function by finite differences on nine equidistant points, exact for
// polynomials of degree eight. Weights: Fornberg (1988), Generation of finite difference formulas on arbitrarily spaced
// grids, Math. Comp. 51.
//
// For sin(w t), evaluated in the middle of points with spacing h, the errors of the first and second derivative
// relative to w and w^2 are about (w h)^8/630 + eps/(w h) and (w h)^8/3150 + 4 eps/(w h)^2, with the machine epsilon
// eps. Both are below 1e-10 for 60 to 1000 points per period.
#pragma once

#include <array>
#include <vector>

#include "lib/ode/step_limits.h"

namespace orthodyn {

// Spacing of the points (s): either given, or chosen at each time so that 60 to 1000 points cover the local period of
// the function.
class DifferenceStep {
 public:
  explicit DifferenceStep(double given) : longest_(given) {}
  // `limits`: step limits of the function from `start` to `end` (s).
  DifferenceStep(StepLimits limits, double start, double end);
  double at(double t) const;

 private:
  double longest_;
  StepLimits limits_;
};

template <class T>
struct Differences {
  T first, second;
};

// Weights of the first and second derivative at x for function values at 0, 1, ..., 8.
struct DifferenceWeights {
  explicit DifferenceWeights(double x);
  static constexpr std::size_t kPoints = 9;
  std::array<double, kPoints> first, second;
};

// Nine points around t, at most `step` apart, with no kink between them. If t is a kink, the points lie to its right.
struct SmoothStretch {
  SmoothStretch(double t, double step, const std::vector<double>& kinks);
  double point(std::size_t k) const { return begin + static_cast<double>(k) * h; }
  double begin, h;
};

// First and second derivative of f at t. T is a number or a matrix of fixed size.
template <class T, class F>
Differences<T> smooth_differences(const F& f, double t, double step, const std::vector<double>& kinks) {
  const SmoothStretch at(t, step, kinks);
  const DifferenceWeights w((t - at.begin) / at.h);
  const T start = f(at.point(0));
  Differences<T> out{w.first[0] / at.h * start, w.second[0] / (at.h * at.h) * start};
  for (std::size_t k = 1; k < DifferenceWeights::kPoints; ++k) {
    const T value = f(at.point(k));
    out.first += w.first[k] / at.h * value;
    out.second += w.second[k] / (at.h * at.h) * value;
  }
  return out;
}

}  // namespace orthodyn
