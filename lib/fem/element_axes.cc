#include "lib/fem/element_axes.h"

#include <algorithm>

#include "lib/element/polar.h"

namespace orthodyn {

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

Mat3 ElementAxes::mean(int k) const {
  if (points_ == 1) return of(k, 0);
  Mat3 sum = Mat3::Zero();
  for (int p = 0; p < points_; ++p) sum += of(k, p);
  return polar(sum, of(k, 0)).R;
}

}  // namespace orthodyn
