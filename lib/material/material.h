// A material: density and elasticity tensor in its own axes. One kind per file, chosen in the input
// by `type` through Registry<Material>.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/registry.h"
#include "lib/material/stiffness.h"
#include "lib/material/strength.h"

namespace orthodyn {

class Material {
 public:
  virtual ~Material() = default;
  virtual double density() const { return density_; }  // kg/m^3
  virtual Stiffness stiffness() const = 0;             // positive definite
  // Empty if no strengths are given; failure criteria are then unavailable.
  virtual std::optional<Strength> strength() const { return strength_; }

  // Changes made to the input to make it usable, a sentence each.
  virtual std::vector<std::string> notes() const { return {}; }

 protected:
  double density_ = 0;
  std::optional<Strength> strength_;
};

inline constexpr const char* kStrengthSentence =
    "Strengths along the material axes, for the fields max_stress, tsai_wu and hashin.";

}  // namespace orthodyn
