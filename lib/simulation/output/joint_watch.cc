#include "lib/simulation/output/joint_watch.h"

#include <algorithm>

namespace orthodyn {

void JointWatch::observe(const ObservedState& observed) {
  largest_.gap = std::max(largest_.gap, observed.evaluate("joints.gap")[0]);
  largest_.rate = std::max(largest_.rate, observed.evaluate("joints.rate")[0]);
}

void JointWatch::save(Archive& archive) { archive.put("largest", {largest_.gap, largest_.rate}); }

void JointWatch::restore(const Archive& archive) {
  const auto& largest = archive.numbers("largest", 2);
  largest_ = {largest[0], largest[1]};
}

}  // namespace orthodyn
