// Single lanes of batches, for functions that have no batch version.
#pragma once

#include "lib/element/batch.h"

namespace orthodyn {

inline Mat3 lane_of(const Mat3T<Batch>& m, int lane) {
  return m.unaryExpr([lane](const Batch& x) { return x[lane]; });
}

inline void set_lane(Batch& all, int lane, double value) {
  double lanes[Batch::kLanes];
  all.store(lanes);
  lanes[lane] = value;
  all = Batch::load(lanes);
}
inline void set_lane(Mat3T<Batch>& all, int lane, const Mat3& value) {
  for (int i = 0; i < 9; ++i) set_lane(all(i), lane, value(i));
}

// Calls visit(lane) for the lanes outside of the mask.
template <class Visit>
void for_each_lane_outside(const Batch::Mask& mask, Visit&& visit) {
  for (int l = 0; l < Batch::kLanes; ++l)
    if (!mask[l]) visit(l);
}

// The number f(lane) in each lane.
template <class Function>
Batch per_lane(Function&& f) {
  double lanes[Batch::kLanes];
  for (int l = 0; l < Batch::kLanes; ++l) lanes[l] = f(l);
  return Batch::load(lanes);
}

}  // namespace orthodyn
