// Transverse isotropy: axis 1 is the fibre, the plane 2-3 is isotropic:
//     E1 = young_axial, E2 = E3 = young_transverse, nu12 = nu13 = nu_axial, nu23 = nu_transverse,
//     G12 = G13 = shear_axial, G23 = E2 / (2 (1 + nu23)).
// With the unit vectors e_i, Rho (orthotropy.h) has the eigenvector e2 - e3 with the eigenvalue 1 + nu23, and a 2x2
// block on e1 and e2 + e3. The material is stable if and only if |nu23| < 1 and 1 - nu23 - 2 nu12^2 E2/E1 > 0.
#include <fmt/format.h>

#include <cmath>

#include "lib/material/material.h"
#include "lib/material/orthotropy.h"

namespace orthodyn {
namespace {

class TransverselyIsotropic : public Material {
 public:
  static const Spec<TransverselyIsotropic>& spec() {
    using M = TransverselyIsotropic;
    const Rule modulus{.required = true, .unit = "Pa", .range = kPositive};
    static const auto s =
        Spec<M>()
            .key("density", &M::density_, "Mass density.", {.required = true, .unit = "kg/m^3", .range = kPositive})
            .key("young_axial", &M::young_axial_, "Young's modulus E1 along the fibre, which is material axis 1.",
                 modulus)
            .key("young_transverse", &M::young_transverse_, "Young's modulus E2 = E3 across the fibre.", modulus)
            .key("nu_axial", &M::nu_axial_,
                 "nu12 = nu13: contraction across the fibre when stretched along it; may exceed 1/2.",
                 {.required = true})
            .key("nu_transverse", &M::nu_transverse_,
                 "nu23 = nu32: contraction across when stretched across; sets G23 = E2/(2 (1 + nu23)).",
                 {.required = true})
            .key("shear_axial", &M::shear_axial_, "Shear modulus G12 = G13 of the planes that contain the fibre.",
                 modulus)
            .key("strength", &M::strength_, kStrengthSentence)
            .key("expansion", &M::expansion_, kExpansionSentence)
            .key("fibres", &M::fibres_, kFibresSentence)
            .key("viscoelastic", &M::viscoelasticity_, kViscoelasticSentence)
            .key("repair", &M::repair_,
                 "Treatment of constants that make the material unstable. none: refuse them. shrink: multiply both "
                 "ratios by the largest factor that makes it stable, with a warning.")
            .check([](const M& m, const Config& config) {
              if (m.is_given_stable()) return;
              if (m.repair_ == RatioRepair::none) config.fail(m.explained());
              config.fill("nu_axial", number_text(m.factor() * m.nu_axial_));
              config.fill("nu_transverse", number_text(m.factor() * m.nu_transverse_));
            });
    return s;
  }

  Stiffness stiffness() const override { return orthodyn::stiffness(constants(is_given_stable() ? 1 : factor())); }

  std::vector<std::string> notes() const override {
    if (is_given_stable()) return {};
    return {
        fmt::format("nu_axial={:.4g}, nu_transverse={:.4g} make the stiffness indefinite ({}); both were multiplied by "
                    "{:.4g}, used are nu_axial={:.6g}, nu_transverse={:.6g}",
                    nu_axial_, nu_transverse_, violated(), factor(), factor() * nu_axial_, factor() * nu_transverse_)};
  }

 private:
  // The constants with both Poisson's ratios multiplied by s.
  OrthotropicConstants constants(double s) const {
    OrthotropicConstants c;
    c.young = {young_axial_, young_transverse_, young_transverse_};
    c.nu12 = c.nu13 = s * nu_axial_;
    c.nu23 = s * nu_transverse_;
    c.g12 = c.g13 = shear_axial_;
    c.g23 = young_transverse_ / (2 * (1 + c.nu23));
    return c;
  }

  double factor() const { return stabilising_factor(constants(1)); }

  // nu23 > -1 implies G23 > 0.
  bool is_given_stable() const { return nu_transverse_ > -1 && is_stable(constants(1)); }

  double determinant() const {
    return 1 - nu_transverse_ - 2 * nu_axial_ * nu_axial_ * young_transverse_ / young_axial_;
  }

  std::string violated() const {
    if (std::abs(nu_transverse_) >= 1) return "|nu_transverse| < 1 is violated";
    return fmt::format("1 - nu_transverse - 2 nu_axial^2 young_transverse/young_axial > 0 is violated: it is {:.4g}",
                       determinant());
  }

  std::string explained() const {
    std::string allowed = "nu_transverse must lie in (-1, 1)";
    if (std::abs(nu_transverse_) < 1)
      allowed = fmt::format("For these moduli and nu_transverse |nu_axial| must be below {:.4g}",
                            std::sqrt((1 - nu_transverse_) * young_axial_ / (2 * young_transverse_)));
    return fmt::format(
        "nu_axial={:.4g}, nu_transverse={:.4g} make the stiffness indefinite: {}. {}. Nearest stable set (both ratios "
        "times {:.4g}): nu_axial: {:.6g}, nu_transverse: {:.6g}. Or set repair: shrink.",
        nu_axial_, nu_transverse_, violated(), allowed, factor(), factor() * nu_axial_, factor() * nu_transverse_);
  }

  double young_axial_ = 0, young_transverse_ = 0, nu_axial_ = 0, nu_transverse_ = 0, shear_axial_ = 0;
  RatioRepair repair_ = RatioRepair::none;
};

const bool transversely_isotropic_registered = Registry<Material>::add<TransverselyIsotropic>(
    "transversely_isotropic",
    "Fibres along axis 1, with equal properties in all directions across them: five constants.");

}  // namespace
}  // namespace orthodyn
