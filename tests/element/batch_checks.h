// For tests of laws in batches: matrices in all lanes, and derivatives by the observed order of central differences.
#pragma once

#include <gtest/gtest.h>

#include "lib/element/batch.h"

namespace orthodyn {

inline Mat3T<Batch> everywhere(const Mat3& m) { return m.cast<Batch>(); }

template <class M>
auto lane_of_matrix(const M& m, int lane) {
  return m.unaryExpr([lane](const Batch& x) { return x[lane]; }).eval();
}
template <class M>
auto first_lane(const M& m) {
  return lane_of_matrix(m, 0);
}

// error(h): relative error of the difference at the step h.
template <class F>
void expect_order_two(const F& error) {
  const double coarse = error(2e-4), fine = error(1e-4);
  if (fine > 1e-9) {
    EXPECT_NEAR(coarse / fine, 4, 0.2);
  }
  EXPECT_LE(fine, 1e-4);
}

}  // namespace orthodyn
