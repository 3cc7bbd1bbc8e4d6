// The material axes of a region's elements: one rotation for all, or one at each integration point.
//
// Those of each point are kept as unit quaternions: 32 bytes instead of 72.
#pragma once

#include <array>
#include <vector>

#include "lib/element/batch.h"

namespace orthodyn {

class ElementAxes {
 public:
  ElementAxes(const Mat3& all) : all_(all) {}  // NOLINT: a rotation is the axes of all elements
  // One after the other those at the points of each element. Preconditions: at least one element; rotations.
  explicit ElementAxes(const std::vector<Mat3>& each, int points = 1);

  bool uniform() const { return packs_.empty(); }
  std::size_t bytes() const { return packs_.capacity() * sizeof(Pack); }

  // At a point of element k: a rotation to round-off whose columns are the directions 1, 2, 3.
  Mat3 of(int k, int point) const {
    if (uniform()) return all_;
    const Pack& pack = at(k / Batch::kLanes, point);
    const auto lane = static_cast<std::size_t>(k % Batch::kLanes);
    return rotation<double>(pack[0][lane], pack[1][lane], pack[2][lane], pack[3][lane]);
  }

  // The mean over the points of element k, for what is told of the whole element.
  Mat3 mean(int k) const;

  // At a point of a batch of elements, Batch::kLanes of them, and copies beyond the last one.
  Mat3T<Batch> batch(int b, int point) const {
    if (uniform()) return all_.cast<Batch>();
    const Pack& pack = at(b, point);
    return rotation<Batch>(Batch::load(pack[0].data()), Batch::load(pack[1].data()), Batch::load(pack[2].data()),
                           Batch::load(pack[3].data()));
  }

 private:
  using Pack = std::array<std::array<double, static_cast<std::size_t>(Batch::kLanes)>, 4>;  // w, x, y, z

  template <class T>
  static Mat3T<T> rotation(const T& w, const T& x, const T& y, const T& z) {
    const T two(2), one(1);
    Mat3T<T> Q;
    Q(0, 0) = one - two * (y * y + z * z);
    Q(1, 1) = one - two * (x * x + z * z);
    Q(2, 2) = one - two * (x * x + y * y);
    Q(0, 1) = two * (x * y - w * z);
    Q(1, 0) = two * (x * y + w * z);
    Q(0, 2) = two * (x * z + w * y);
    Q(2, 0) = two * (x * z - w * y);
    Q(1, 2) = two * (y * z - w * x);
    Q(2, 1) = two * (y * z + w * x);
    return Q;
  }

  const Pack& at(int batch, int point) const { return packs_[static_cast<std::size_t>(batch * points_ + point)]; }

  Mat3 all_ = Mat3::Identity();
  int points_ = 1;
  std::vector<Pack> packs_;  // of each batch those of its points
};

}  // namespace orthodyn
