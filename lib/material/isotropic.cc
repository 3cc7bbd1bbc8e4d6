// Isotropic elasticity from Young's modulus and Poisson's ratio.
#include "lib/material/material.h"

namespace orthodyn {
namespace {

class Isotropic : public Material {
 public:
  static const Spec<Isotropic>& spec() {
    static const auto s =
        Spec<Isotropic>()
            .key("density", &Isotropic::density_, "Mass density.",
                 {.required = true, .unit = "kg/m^3", .range = kPositive})
            .key("young", &Isotropic::young_, "Young's modulus.", {.required = true, .unit = "Pa", .range = kPositive})
            .key("nu", &Isotropic::nu_, "Poisson's ratio.", {.required = true, .range = {-1, 0.5, true, true}})
            .key("strength", &Isotropic::uniform_, "Strengths, for the fields max_stress, tsai_wu and hashin.")
            .key("expansion", &Isotropic::expansion_of_all_, kExpansionSentence)
            .key("fibres", &Isotropic::fibres_, kFibresSentence)
            .key("viscoelastic", &Isotropic::viscoelasticity_, kViscoelasticSentence);
    return s;
  }

  Stiffness stiffness() const override { return isotropic_stiffness(young_, nu_); }
  std::optional<Strength> strength() const override {
    return uniform_ ? std::optional(uniform_->everywhere()) : std::nullopt;
  }

  std::optional<Expansion> expansion() const override {
    return expansion_of_all_ ? std::optional(expansion_of_all_->everywhere()) : std::nullopt;
  }

 private:
  double young_ = 0, nu_ = 0;
  std::optional<UniformStrength> uniform_;
  std::optional<UniformExpansion> expansion_of_all_;
};

const bool isotropic_registered =
    Registry<Material>::add<Isotropic>("isotropic", "The same stiffness in every direction.");

}  // namespace
}  // namespace orthodyn
