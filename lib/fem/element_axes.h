// The material axes of a region's elements: one rotation for all, or one at each integration point.
//
// Those of each point are kept as unit quaternions: 32 bytes instead of 72.
#pragma once

#include <array>
#include <vector>

#include "lib/element/batch.h"

namespace orthodyn {

inline namespace ORTHODYN_LANES {

class ElementAxes {
 public:
  ElementAxes(const Mat3& all) : all_(all) {}  // NOLINT: a rotation is the axes of all elements
  // One after the other those at the points of each element. Preconditions: at least one element; rotations.
  explicit ElementAxes(const std::vector<Mat3>& each, int points = 1);

  bool uniform() const { return packs_.empty(); }
  std::size_t bytes() const { return packs_.capacity() * sizeof(Pack); }

  // At a point of element k: a rotation to round-off whose columns are the directions 1, 2, 3.
  Mat3 of(int k, int point) const;

  // The mean over the points of element k, for what is told of the whole element.
  Mat3 mean(int k) const;

  // At a point of a batch of elements, Batch::kLanes of them, and copies beyond the last one.
  Mat3T<Batch> batch(int b, int point) const;

 private:
  using Pack = std::array<std::array<double, static_cast<std::size_t>(Batch::kLanes)>, 4>;  // w, x, y, z

  const Pack& at(int batch, int point) const { return packs_[static_cast<std::size_t>(batch * points_ + point)]; }

  Mat3 all_ = Mat3::Identity();
  int points_ = 1;
  std::vector<Pack> packs_;  // of each batch those of its points
};

}  // namespace ORTHODYN_LANES

}  // namespace orthodyn
