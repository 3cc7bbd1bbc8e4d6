// Shares of a span that fill it evenly and fall on no beat: evenly spaced ones may all be zeros of an oscillation.
#pragma once

#include <cmath>
#include <numbers>

namespace orthodyn {

// Number k = 0, 1, ... of a sequence in [0, 1): the fractions of k times the golden ratio.
inline double golden_ratio_sample(int k) {
  const double turns = k * std::numbers::phi;
  return turns - std::floor(turns);
}

}  // namespace orthodyn
