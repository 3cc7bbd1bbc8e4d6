// Orthotropic elasticity from nine engineering constants, each pair (i, j) named once.
#include <fmt/format.h>

#include <optional>

#include "lib/material/material.h"
#include "lib/material/orthotropy.h"

namespace orthodyn {
namespace {

class Orthotropic : public Material {
 public:
  using Ratio = std::optional<double>;

  static const Spec<Orthotropic>& spec() {
    using O = Orthotropic;
    const Rule modulus{.required = true, .unit = "Pa", .range = kPositive};
    static const auto s =
        Spec<O>()
            .key("density", &O::density_, "Mass density.",
                 {.required = true, .unit = "kg/m^3", .range = kPositive})
            .key("young", &O::young_, "Young's moduli E1, E2, E3 along the material axes.", modulus)
            .key("nu12", &O::nu12_, "Contraction along 2 when stretched along 1 (or give nu21).")
            .key("nu21", &O::nu21_, "Contraction along 1 when stretched along 2; nu21 = nu12 E2/E1.")
            .key("nu23", &O::nu23_, "Contraction along 3 when stretched along 2 (or give nu32).")
            .key("nu32", &O::nu32_, "Contraction along 2 when stretched along 3; nu32 = nu23 E3/E2.")
            .key("nu13", &O::nu13_, "Contraction along 3 when stretched along 1 (or give nu31).")
            .key("nu31", &O::nu31_, "Contraction along 1 when stretched along 3; nu31 = nu13 E3/E1.")
            .key("g12", &O::g12_, "Shear modulus in the plane 1-2.", modulus)
            .key("g23", &O::g23_, "Shear modulus in the plane 2-3.", modulus)
            .key("g13", &O::g13_, "Shear modulus in the plane 1-3.", modulus)
            .check([](const O& o, const Config& config) {
              o.refuse_unpaired(config);
              if (!is_stable(o.constants())) {
                config.fail(explain_instability(o.constants(), {!o.nu12_, !o.nu23_, !o.nu13_}));
              }
            });
    return s;
  }

  Stiffness stiffness() const override { return orthodyn::stiffness(constants()); }

 private:
  void refuse_unpaired(const Config& config) const {
    const auto once = [&](const Ratio& a, const Ratio& b, const char* ij, const char* ji) {
      if (!a && !b)
        config.fail(fmt::format("a Poisson's ratio is missing: give {} or {}", ij, ji));
      if (a && b)
        config.fail(fmt::format("{} and {} are the same constant ({} E{} = {} E{}); give one", ij, ji, ij, ij[3], ji, ji[3]));
    };
    once(nu12_, nu21_, "nu12", "nu21");
    once(nu23_, nu32_, "nu23", "nu32");
    once(nu13_, nu31_, "nu13", "nu31");
  }

  OrthotropicConstants constants() const {
    const auto& E = young_;
    OrthotropicConstants c;
    c.young = E;
    c.nu12 = nu12_ ? *nu12_ : *nu21_ * E[0] / E[1];
    c.nu23 = nu23_ ? *nu23_ : *nu32_ * E[1] / E[2];
    c.nu13 = nu13_ ? *nu13_ : *nu31_ * E[0] / E[2];
    c.g12 = g12_;
    c.g23 = g23_;
    c.g13 = g13_;
    return c;
  }

  Vec3 young_ = Vec3::Zero();
  Ratio nu12_, nu21_, nu23_, nu32_, nu13_, nu31_;
  double g12_ = 0, g23_ = 0, g13_ = 0;
};

const bool registered = Registry<Material>::add<Orthotropic>(
    "orthotropic", "Nine measured constants: three Young's moduli, three Poisson's ratios, three shear moduli.");

}  // namespace
}  // namespace orthodyn
