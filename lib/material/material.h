// A material: density and elasticity tensor in its own axes. One type per file, registered in Registry<Material>.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/registry.h"
#include "lib/material/expansion.h"
#include "lib/material/fibres/fibres.h"
#include "lib/material/stiffness.h"
#include "lib/material/strength.h"
#include "lib/material/viscoelasticity.h"

namespace orthodyn {

class Material {
 public:
  virtual ~Material() = default;
  virtual double density() const { return density_; }  // kg/m^3
  virtual Stiffness stiffness() const = 0;             // positive definite
  // Empty if no strengths are given; failure criteria are then unavailable.
  virtual std::optional<Strength> strength() const { return strength_; }

  // Empty if no coefficients are given; the material then does not swell.
  virtual std::optional<Expansion> expansion() const { return expansion_; }

  // Empty if the material has no fibres besides its elasticity.
  const std::optional<Fibres>& fibres() const { return fibres_; }

  // Empty if the stiffness does not relax.
  const Viscoelasticity& viscoelasticity() const { return viscoelasticity_; }

  // Changes made to the given constants, one sentence each.
  virtual std::vector<std::string> notes() const { return {}; }

 protected:
  double density_ = 0;
  std::optional<Strength> strength_;
  std::optional<Expansion> expansion_;
  std::optional<Fibres> fibres_;
  Viscoelasticity viscoelasticity_;
};

inline constexpr const char* kStrengthSentence =
    "Strengths along the material axes, for the fields max_stress, tsai_wu and hashin.";

// Why a material cannot be used, as a sentence; "" if it can: its density is positive, and its stiffness finite,
// symmetric and positive definite.
std::string why_inadmissible(const Material& material);

// What to do if the given constants make the stiffness indefinite. none: refuse them. shrink: multiply the constants
// that couple strains by the largest common factor that makes it positive definite, with a warning.
enum class RatioRepair { none, shrink };

template <>
struct EnumNames<RatioRepair> {
  static constexpr std::array<std::pair<RatioRepair, const char*>, 2> list{
      {{RatioRepair::none, "none"}, {RatioRepair::shrink, "shrink"}}};
};

}  // namespace orthodyn
