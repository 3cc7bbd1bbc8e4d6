// Checks derivatives by the observed convergence order of central differences.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/types.h"

namespace orthodyn {

inline constexpr double kStep = 4e-3;

// Central differences of f at steps h and h/2 against `expected`: errors of order 2, or of none but
// round-off if f is linear (quadratic) along the line.
template <class F>
void expect_derivative(const F& f, const Vector& expected) {
  const auto error = [&](double h) -> double { return (Vector(f(h) - f(-h)) / (2 * h) - expected).norm(); };
  const double coarse = error(kStep), fine = error(kStep / 2);
  if (fine < 1e-11 * expected.norm()) return;
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << coarse << " " << fine << " of " << expected.norm();
  EXPECT_LE(fine, 0.01 * expected.norm());
}

inline Vector one(double x) { return Vector::Constant(1, x); }

}  // namespace orthodyn
