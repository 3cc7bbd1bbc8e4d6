// The material axes of a region's elements: one rotation for all, or one for each.
//
// Those of each element are kept as unit quaternions: 32 bytes instead of 72.
#pragma once

#include <array>
#include <vector>

#include "lib/element/batch.h"

namespace orthodyn {

class ElementAxes {
 public:
  ElementAxes(const Mat3& all) : all_(all) {}  // NOLINT: a rotation is the axes of all elements
  // Precondition: at least one; rotations.
  explicit ElementAxes(const std::vector<Mat3>& each);

  bool uniform() const { return packs_.empty(); }
  std::size_t bytes() const { return packs_.capacity() * sizeof(Pack); }

  // A rotation to round-off whose columns are the directions 1, 2, 3.
  Mat3 of(int k) const {
    if (uniform()) return all_;
    const Pack& pack = packs_[static_cast<std::size_t>(k / Batch::kLanes)];
    const auto lane = static_cast<std::size_t>(k % Batch::kLanes);
    return rotation<double>(pack[0][lane], pack[1][lane], pack[2][lane], pack[3][lane]);
  }

  // Those of a batch of elements, Batch::kLanes of them, and copies beyond the last one.
  Mat3T<Batch> batch(int b) const {
    if (uniform()) return all_.cast<Batch>();
    const Pack& pack = packs_[static_cast<std::size_t>(b)];
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

  Mat3 all_ = Mat3::Identity();
  std::vector<Pack> packs_;
};

}  // namespace orthodyn
