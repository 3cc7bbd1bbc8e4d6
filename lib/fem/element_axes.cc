#include "lib/fem/element_axes.h"

#include <algorithm>

#include "lib/element/polar.h"

namespace orthodyn {

namespace {

// Rotation matrix of a unit quaternion.
template <class T>
Mat3T<T> unit_rotation(const T& w, const T& x, const T& y, const T& z) {
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

}  // namespace

ElementAxes::ElementAxes(const std::vector<Mat3>& each, int points) : points_(points) {
  constexpr auto kLanes = static_cast<std::size_t>(Batch::kLanes);
  const auto per_element = static_cast<std::size_t>(points), size = each.size() / per_element;
  packs_.resize((size + kLanes - 1) / kLanes * per_element);
  for (std::size_t k = 0; k < packs_.size() / per_element * kLanes; ++k)
    for (std::size_t p = 0; p < per_element; ++p) {
      const Eigen::Quaterniond q = Eigen::Quaterniond(each[std::min(k, size - 1) * per_element + p]).normalized();
      Pack& pack = packs_[k / kLanes * per_element + p];
      const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
      for (std::size_t i = 0; i < 4; ++i) pack[i][k % kLanes] = wxyz[i];
    }
}

Mat3 ElementAxes::of(int k, int point) const {
  if (uniform()) return all_;
  const Pack& pack = at(k / Batch::kLanes, point);
  const auto lane = static_cast<std::size_t>(k % Batch::kLanes);
  return unit_rotation<double>(pack[0][lane], pack[1][lane], pack[2][lane], pack[3][lane]);
}

Mat3T<Batch> ElementAxes::batch(int b, int point) const {
  if (uniform()) return all_.cast<Batch>();
  const Pack& pack = at(b, point);
  return unit_rotation<Batch>(Batch::load(pack[0].data()), Batch::load(pack[1].data()), Batch::load(pack[2].data()),
                              Batch::load(pack[3].data()));
}

Mat3 ElementAxes::mean(int k) const {
  if (points_ == 1) return of(k, 0);
  Mat3 sum = Mat3::Zero();
  for (int p = 0; p < points_; ++p) sum += of(k, p);
  return polar(sum, of(k, 0)).R;
}

}  // namespace orthodyn
