#include "lib/simulation/output/joint_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orthodyn {

void JointWatch::observe(const ObservedState& observed) {
  largest_.gap = std::max(largest_.gap, observed.evaluate("joints.gap")[0]);
  largest_.rate = std::max(largest_.rate, observed.evaluate("joints.rate")[0]);
  for (std::size_t k = 0; k < sprung_.size(); ++k)
    farthest_[k] = std::max(farthest_[k], std::abs(observed.evaluate("coordinate." + sprung_[k])[0]));
}

JointErrors JointWatch::largest() const {
  JointErrors out = largest_;
  for (std::size_t k = 0; k < sprung_.size(); ++k)
    if (farthest_[k] > std::numbers::pi) out.wound.push_back(sprung_[k]);
  return out;
}

void JointWatch::save(Archive& archive) {
  archive.put("largest", {largest_.gap, largest_.rate});
  archive.put("farthest", farthest_);
}

void JointWatch::restore(const Archive& archive) {
  const auto& largest = archive.numbers("largest", 2);
  largest_ = {largest[0], largest[1]};
  farthest_ = archive.numbers("farthest", farthest_.size());
}

}  // namespace orthodyn
