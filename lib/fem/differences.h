// First and second derivative of a function of time by differences on nine equidistant points, exact for
// polynomials of degree eight; weights by Fornberg (1988), Generation of finite difference formulas on
// arbitrarily spaced grids, Math. Comp. 51.
//
// For sin(w t) with t in the middle of the points, h apart, the errors relative to w and w^2 are about
// (w h)^8/630 + eps/(w h) and (w h)^8/3150 + 4 eps/(w h)^2: below 1e-10 for periods of 60 to 1000 steps.
#pragma once

#include <array>
#include <vector>

#include "lib/ode/step_limits.h"

namespace orthodyn {

// The step of the differences, s: a given one, or one chosen at each time so that the function's period about that time
// has 60 to 1000 steps.
class DifferenceStep {
 public:
  explicit DifferenceStep(double given) : longest_(given) {}
  // limits: of the function between start and end, s.
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

// Weights of the two derivatives at x, for the values at 0, 1, ..., 8.
struct DifferenceWeights {
  explicit DifferenceWeights(double x);
  static constexpr std::size_t kPoints = 9;
  std::array<double, kPoints> first, second;
};

// Nine points about t, no further apart than `step` and all on t's side of every kink; at a kink to its right.
struct SmoothStretch {
  SmoothStretch(double t, double step, const std::vector<double>& kinks);
  double point(std::size_t k) const { return begin + static_cast<double>(k) * h; }
  double begin, h;
};

// T is a number or a matrix of fixed size.
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
