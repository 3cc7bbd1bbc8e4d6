// Material axes of the elements of a region: one rotation for all, or one per integration point, stored as unit
// quaternions (32 bytes instead of 72).
#pragma once

#include <array>
#include <vector>

#include "lib/element/batch.h"

namespace orthodyn {

inline namespace ORTHODYN_LANES {

class ElementAxes {
 public:
  ElementAxes(const Mat3& all) : all_(all) {}  // NOLINT: implicit, one rotation for all elements
  // `each`: the rotations of the points of the first element, then of the second, and so on. Precondition: at least one
  // element.
  explicit ElementAxes(const std::vector<Mat3>& each, int points = 1);

  bool uniform() const { return packs_.empty(); }
  std::size_t bytes() const { return packs_.capacity() * sizeof(Pack); }

  // Axes at a point of element k: an orthonormal matrix whose columns are the directions 1, 2, 3.
  Mat3 of(int k, int point) const;

  // Mean rotation over the points of element k, for outputs per element.
  Mat3 mean(int k) const;

  // Axes at a point of all elements of a batch; lanes after the last element repeat it.
  Mat3T<Batch> batch(int b, int point) const;

 private:
  using Pack = std::array<std::array<double, static_cast<std::size_t>(Batch::kLanes)>, 4>;  // w, x, y, z

  const Pack& at(int batch, int point) const { return packs_[static_cast<std::size_t>(batch * points_ + point)]; }

  Mat3 all_ = Mat3::Identity();
  int points_ = 1;
  std::vector<Pack> packs_;  // batch-major, one per point
};

}  // namespace ORTHODYN_LANES

}  // namespace orthodyn
