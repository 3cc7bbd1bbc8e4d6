#include "integrators/native/stability_watch.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

namespace {

constexpr int kFirstInterval = 50, kShortestInterval = 20, kLongestInterval = 800;
constexpr double kSmallChange = 0.005, kLargeChange = 0.02;

}  // namespace

void StabilityWatch::update(const State& state) {
  if (constant_ && step_ > 0) return;
  const double before = step_;
  step_ = critical_.at(state);
  if (interval_ == 0) interval_ = kFirstInterval;
  else if (const double change = std::abs(step_ / before - 1); change > kLargeChange) interval_ /= 2;
  else if (change < kSmallChange) interval_ += interval_ / 2;
  left_ = interval_ = std::clamp(interval_, kShortestInterval, kLongestInterval);
}

}  // namespace orthodyn
