// The places of contact at the last positions: the force, the energy and the tangent of one state search once.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "lib/fem/contact/near_features.h"

namespace orthodyn {

// Functions may run concurrently.
class RememberedPlaces {
 public:
  using Places = std::shared_ptr<const std::vector<NearPlace>>;

  // The places of last time if the nodes of both surfaces have the same positions, else those that find() returns.
  template <class Find>
  Places at(const ContactSurface& first, const ContactSurface& second, const NodalVector& x, Find&& find) const {
    Eigen::Matrix3Xd here(3, std::ssize(first.areas()) + std::ssize(second.areas()));
    Eigen::Index column = 0;
    for (const ContactSurface* surface : {&first, &second})
      for (const auto& [node, area] : surface->areas()) here.col(column++) = x.col(node);
    {
      const std::lock_guard lock(mutex_);
      if (places_ && here == positions_) return places_;
    }
    auto found = std::make_shared<const std::vector<NearPlace>>(find());
    const std::lock_guard lock(mutex_);
    positions_ = std::move(here);
    places_ = found;
    return found;
  }

 private:
  mutable std::mutex mutex_;
  mutable Eigen::Matrix3Xd positions_;  // m
  mutable Places places_;
};

}  // namespace orthodyn
