// Material axes of wood and tubes from the directions L (longitudinal), R (radial) and T = L x R (tangential).
#pragma once

#include <cmath>

#include "lib/config/values.h"
#include "lib/material_axes/frame.h"

namespace orthodyn {

enum class LrtOrder { LRT, LTR, RLT, RTL, TLR, TRL };

template <>
struct EnumNames<LrtOrder> {
  using E = LrtOrder;
  static constexpr std::array<std::pair<E, const char*>, 6> list{
      {{E::LRT, "LRT"}, {E::LTR, "LTR"}, {E::RLT, "RLT"}, {E::RTL, "RTL"}, {E::TLR, "TLR"}, {E::TRL, "TRL"}}};
};

inline constexpr const char* kLrtSentence =
    "Directions of the material axes 1, 2, 3: L longitudinal, R radial, T tangential.";
inline constexpr const char* kSpiralSentence = "Spiral grain: angle of L towards T = L x R, about R.";
inline constexpr Range kSpiralRange{-1.57, 1.57};

// `along` and `radial`: nonzero, not parallel; `spiral` in rad.
inline Mat3 lrt_axes(const Vec3& along, const Vec3& radial, LrtOrder order, double spiral) {
  Mat3 lrt = frame(along, radial);
  const Vec3 L = lrt.col(0), T = lrt.col(2);
  lrt.col(0) = std::cos(spiral) * L + std::sin(spiral) * T;
  lrt.col(2) = std::cos(spiral) * T - std::sin(spiral) * L;
  return in_order(lrt, "LRT", Value<LrtOrder>::yaml(order));
}

}  // namespace orthodyn
