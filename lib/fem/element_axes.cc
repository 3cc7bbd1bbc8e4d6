#include "lib/fem/element_axes.h"

namespace orthodyn {

ElementAxes::ElementAxes(const std::vector<Mat3>& each) {
  constexpr auto kLanes = static_cast<std::size_t>(Batch::kLanes);
  packs_.resize((each.size() + kLanes - 1) / kLanes);
  for (std::size_t k = 0; k < packs_.size() * kLanes; ++k) {
    const Eigen::Quaterniond q = Eigen::Quaterniond(k < each.size() ? each[k] : each[0]).normalized();
    Pack& pack = packs_[k / kLanes];
    const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
    for (std::size_t i = 0; i < 4; ++i) pack[i][k % kLanes] = wxyz[i];
  }
}

}  // namespace orthodyn
