// The three directions of wood and of tubes: L along, R radial, T tangential, with T = L x R; and which
// of the material axes 1, 2, 3 lies along which.
#pragma once

#include "lib/config/values.h"

namespace orthodyn {

enum class LrtOrder { LRT, LTR, RLT, RTL, TLR, TRL };

template <>
struct EnumNames<LrtOrder> {
  using E = LrtOrder;
  static constexpr std::array<std::pair<E, const char*>, 6> list{
      {{E::LRT, "LRT"}, {E::LTR, "LTR"}, {E::RLT, "RLT"}, {E::RTL, "RTL"}, {E::TLR, "TLR"}, {E::TRL, "TRL"}}};
};

inline constexpr const char* kLrtSentence =
    "Which directions the material axes 1, 2, 3 have: L along, R radial, T tangential.";
inline constexpr const char* kSpiralSentence = "Spiral grain: by how much L is turned towards T = L x R, about R.";
inline constexpr Range kSpiralRange{-1.57, 1.57};

// Material axes from the directions along and radial (neither zero nor parallel).
Mat3 lrt_axes(const Vec3& along, const Vec3& radial, LrtOrder order, double spiral);

}  // namespace orthodyn
