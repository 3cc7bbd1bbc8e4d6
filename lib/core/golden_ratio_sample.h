// A low-discrepancy sequence for sampling times, because evenly spaced samples may all fall on zeros of an oscillation.
#pragma once

#include <cmath>
#include <numbers>

namespace orthodyn {

// Element k = 0, 1, ... of the sequence: the fractional part of k times the golden ratio.
inline double golden_ratio_sample(int k) {
  const double turns = k * std::numbers::phi;
  return turns - std::floor(turns);
}

}  // namespace orthodyn
