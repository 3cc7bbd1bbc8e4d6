// Orthotropic elasticity from nine engineering constants. Each Poisson's ratio is given as nu_ij, nu_ji, or both, of
// which the mean is used.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "lib/material/material.h"
#include "lib/material/orthotropy.h"

namespace orthodyn {
namespace {

// nu_ij and nu_ji; the user gives one or both.
struct Pair {
  std::string ij, ji;  // "nu12", "nu21"
  std::optional<double> nu_ij, nu_ji;
  double root;  // sqrt(E_i / E_j)
  std::string i, j;

  // nu_ij from the mean of nu_ij / E_i and nu_ji / E_j, which are equal for a symmetric C.
  double forward() const {
    if (!nu_ji) return *nu_ij;
    const double from_reverse = *nu_ji * root * root;
    return nu_ij ? 0.5 * (*nu_ij + from_reverse) : from_reverse;
  }
};

class Orthotropic : public Material {
 public:
  using Given = std::optional<double>;

  static const Spec<Orthotropic>& spec() {
    using O = Orthotropic;
    const Rule modulus{.required = true, .unit = "Pa", .range = kPositive};
    static const auto s =
        Spec<O>()
            .key("density", &O::density_, "Mass density.", {.required = true, .unit = "kg/m^3", .range = kPositive})
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
            .key("strength", &O::strength_, kStrengthSentence)
            .key("expansion", &O::expansion_, kExpansionSentence)
            .key("fibres", &O::fibres_, kFibresSentence)
            .key("viscoelastic", &O::viscoelasticity_, kViscoelasticSentence)
            .key("symmetrise", &O::symmetrise_,
                 "For measured sets with both nu_ij and nu_ji: use the mean of nu_ij/Ei and nu_ji/Ej.")
            .key("repair", &O::repair_,
                 "Treatment of constants that make the material unstable. none: refuse them. shrink: multiply all "
                 "ratios by the largest factor that makes it stable, with a warning.")
            .check([](const O& o, const Config& config) {
              o.refuse_unpaired(config);
              if (!is_stable(o.given()) && o.repair_ == RatioRepair::none)
                config.fail(explain_instability(o.given(), o.reversed()) + ". Or set repair: shrink.");
              o.write_used(config);
            });
    return s;
  }

  Stiffness stiffness() const override { return orthodyn::stiffness(used()); }

  std::vector<std::string> notes() const override {
    std::vector<std::string> out;
    for (const Pair& p : pairs())
      if (p.nu_ij && p.nu_ji) out.push_back(averaging(p));
    if (!is_stable(given())) out.push_back(explain_shrinking(given(), reversed()));
    return out;
  }

 private:
  std::array<Pair, 3> pairs() const {
    const auto pair = [&](int i, int j, const Given& nu_ij, const Given& nu_ji) -> Pair {
      const auto a = std::to_string(i + 1), b = std::to_string(j + 1);
      return {"nu" + a + b, "nu" + b + a, nu_ij, nu_ji, std::sqrt(young_[i] / young_[j]), "E" + a, "E" + b};
    };
    return {pair(0, 1, nu12_, nu21_), pair(1, 2, nu23_, nu32_), pair(0, 2, nu13_, nu31_)};
  }

  void refuse_unpaired(const Config& config) const {
    for (const Pair& p : pairs()) {
      if (!p.nu_ij && !p.nu_ji) config.fail(fmt::format("a Poisson's ratio is missing: give {} or {}", p.ij, p.ji));
      if (p.nu_ij && p.nu_ji && !symmetrise_)
        config.fail(fmt::format(
            "{} and {} are the same constant ({} {} = {} {}); give one, or symmetrise: true to use their mean", p.ij,
            p.ji, p.ij, p.j, p.ji, p.i));
    }
  }

  static std::string averaging(const Pair& p) {
    const double a = *p.nu_ij / p.root, b = *p.nu_ji * p.root;  // r_ij from nu_ij and from nu_ji
    const double difference = a == b ? 0 : std::abs(a - b) / (0.5 * (std::abs(a) + std::abs(b)));
    return fmt::format("{}/{} and {}/{} differ by {:.3g} % of their mean; the mean is used: {}={:.6g}, {}={:.6g}", p.ij,
                       p.i, p.ji, p.j, 100 * difference, p.ij, p.forward(), p.ji, p.forward() / (p.root * p.root));
  }

  // True for those of the pairs 12, 23, 13 that the user gives as nu_ji.
  std::array<bool, 3> reversed() const { return {!nu12_, !nu23_, !nu13_}; }

  OrthotropicConstants given() const {
    const auto [p12, p23, p13] = pairs();
    return {young_, p12.forward(), p23.forward(), p13.forward(), g12_, g23_, g13_};
  }

  OrthotropicConstants used() const {
    const auto c = given();
    return is_stable(c) ? c : shrink_ratios(c, stabilising_factor(c));
  }

  // Writes changed ratios into the resolved input.
  void write_used(const Config& config) const {
    const auto c = used();
    const std::array<double, 3> nu{c.nu12, c.nu23, c.nu13};
    const bool shrunk = !is_stable(given());
    for (std::size_t k = 0; k < 3; ++k) {
      const Pair p = pairs()[k];
      if (!shrunk && !(p.nu_ij && p.nu_ji)) continue;
      if (p.nu_ij) config.fill(p.ij, number_text(nu[k]));
      if (p.nu_ji) config.fill(p.ji, number_text(nu[k] / (p.root * p.root)));
    }
  }

  Vec3 young_ = Vec3::Zero();
  Given nu12_, nu21_, nu23_, nu32_, nu13_, nu31_;
  double g12_ = 0, g23_ = 0, g13_ = 0;
  bool symmetrise_ = false;
  RatioRepair repair_ = RatioRepair::none;
};

const bool orthotropic_registered = Registry<Material>::add<Orthotropic>(
    "orthotropic", "Nine measured constants: three Young's moduli, three Poisson's ratios, three shear moduli.");

}  // namespace
}  // namespace orthodyn
