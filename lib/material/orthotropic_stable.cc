// The one-parameter family of Li & Barbic (2014): nu_ij = nu sqrt(E_i/E_j), G_ij = sqrt(E_i E_j) / (2 (1 + nu)). Stable
// for all moduli if and only if -1 < nu < 1/2.
#include <cmath>

#include "lib/material/material.h"
#include "lib/material/orthotropy.h"

namespace orthodyn {
namespace {

class OrthotropicStable : public Material {
 public:
  static const Spec<OrthotropicStable>& spec() {
    using O = OrthotropicStable;
    static const auto s =
        Spec<O>()
            .key("density", &O::density_, "Mass density.", {.required = true, .unit = "kg/m^3", .range = kPositive})
            .key("young", &O::young_, "Young's moduli E1, E2, E3 along the material axes.",
                 {.required = true, .unit = "Pa", .range = kPositive})
            .key("nu", &O::nu_, "Sets Poisson's ratios nu_ij = nu sqrt(Ei/Ej).",
                 {.required = true, .range = {-1, 0.5, true, true}})
            .key("shear_factor", &O::shear_factor_, "Factor of the shear moduli Gij = sqrt(Ei Ej)/(2 (1 + nu)).",
                 {.range = kPositive})
            .key("strength", &O::strength_, kStrengthSentence)
            .key("expansion", &O::expansion_, kExpansionSentence)
            .key("fibres", &O::fibres_, kFibresSentence)
            .key("viscoelastic", &O::viscoelasticity_, kViscoelasticSentence)
            .check([](const O& o, const Config& config) {
              if (!is_stable(o.constants())) config.fail(explain_instability(o.constants()));
            });
    return s;
  }

  Stiffness stiffness() const override { return orthodyn::stiffness(constants()); }

 private:
  OrthotropicConstants constants() const {
    const auto& E = young_;
    const auto shear = [&](int i, int j) { return shear_factor_ * std::sqrt(E[i] * E[j]) / (2 * (1 + nu_)); };
    const auto ratio = [&](int i, int j) { return nu_ * std::sqrt(E[i] / E[j]); };
    return {E, ratio(0, 1), ratio(1, 2), ratio(0, 2), shear(0, 1), shear(1, 2), shear(0, 2)};
  }

  Vec3 young_ = Vec3::Zero();
  double nu_ = 0, shear_factor_ = 1;
};

const bool orthotropic_stable_registered = Registry<Material>::add<OrthotropicStable>(
    "orthotropic_stable", "Three Young's moduli and one ratio nu in (-1, 1/2): stable for all moduli.");

}  // namespace
}  // namespace orthodyn
