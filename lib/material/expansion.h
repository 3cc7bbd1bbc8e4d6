// Expansion of a material by moisture and temperature: strain of the stress-free shape per unit of change.
#pragma once

#include <optional>

#include "lib/config/spec.h"

namespace orthodyn {

// Along the material axes 1, 2, 3.
struct Expansion {
  std::optional<Vec3> moisture;     // per per cent of moisture content
  std::optional<Vec3> temperature;  // 1/K
  static const Spec<Expansion>& spec();
};

// Of an isotropic material.
struct UniformExpansion {
  std::optional<double> moisture, temperature;
  static const Spec<UniformExpansion>& spec();
  Expansion everywhere() const;
};

inline constexpr const char* kExpansionSentence =
    "Strains per per cent of moisture content and per kelvin, for the scene's keys `moisture` and `temperature`.";

}  // namespace orthodyn
