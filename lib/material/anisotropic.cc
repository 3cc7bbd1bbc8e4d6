// All 21 constants of C by name, as tabulated for crystals, bone and homogenised composites.
//
// The shear strains 4, 5, 6 are 23, 13, 12 in most tables, 12, 23, 31 in this project and Li & Barbic, 12, 13, 23 in
// Abaqus. C is positive definite in every order, so a wrong order cannot be detected and the key has no default.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

#include "lib/material/anisotropy.h"
#include "lib/material/material.h"

namespace orthodyn {

enum class VoigtOrder { s23_13_12, s12_23_31, abaqus };

template <>
struct EnumNames<VoigtOrder> {
  static constexpr std::array<std::pair<VoigtOrder, const char*>, 3> list{{{VoigtOrder::s23_13_12, "11-22-33-23-13-12"},
                                                                           {VoigtOrder::s12_23_31, "11-22-33-12-23-31"},
                                                                           {VoigtOrder::abaqus, "abaqus"}}};
};

namespace {

class Anisotropic : public Material {
 public:
  static const Spec<Anisotropic>& spec() {
    static const Spec<Anisotropic> s = declare();
    return s;
  }

  Stiffness stiffness() const override { return used(); }

  std::vector<std::string> notes() const override {
    if (is_stable(given())) return {};
    return {
        fmt::format("the constants make the stiffness indefinite ({}); those off the diagonal were multiplied by "
                    "{:.4g}, used are {}",
                    describe_softest_strain(given()), factor(), couplings(factor(), "{}={:.6g}"))};
  }

 private:
  struct Entry {
    const char* name;  // "c14": row 1, column 4 in the user's order
    double Anisotropic::*value;
    int row() const { return name[1] - '1'; }
    int column() const { return name[2] - '1'; }
    bool diagonal() const { return row() == column(); }
  };

  static const std::array<Entry, 21>& entries() {
    using A = Anisotropic;
    static const std::array<Entry, 21> all{{{"c11", &A::c11_}, {"c12", &A::c12_}, {"c13", &A::c13_}, {"c14", &A::c14_},
                                            {"c15", &A::c15_}, {"c16", &A::c16_}, {"c22", &A::c22_}, {"c23", &A::c23_},
                                            {"c24", &A::c24_}, {"c25", &A::c25_}, {"c26", &A::c26_}, {"c33", &A::c33_},
                                            {"c34", &A::c34_}, {"c35", &A::c35_}, {"c36", &A::c36_}, {"c44", &A::c44_},
                                            {"c45", &A::c45_}, {"c46", &A::c46_}, {"c55", &A::c55_}, {"c56", &A::c56_},
                                            {"c66", &A::c66_}}};
    return all;
  }

  static Spec<Anisotropic> declare() {
    using A = Anisotropic;
    Spec<A> s;
    s.key("density", &A::density_, "Mass density.", {.required = true, .unit = "kg/m^3", .range = kPositive});
    s.key("voigt_order", &A::order_,
          "Meaning of the indices 1 to 6: in most tables 4, 5, 6 are 23, 13, 12, in Abaqus (abaqus) 12, 13, 23.",
          {.required = true});
    s.key("strength", &A::strength_, kStrengthSentence);
    s.key("expansion", &A::expansion_, kExpansionSentence);
    s.key("fibres", &A::fibres_, kFibresSentence).key("viscoelastic", &A::viscoelasticity_, kViscoelasticSentence);
    for (const Entry& e : entries()) {
      const bool needed = e.diagonal() || e.column() < 3;
      s.key(e.name, e.value,
            fmt::format("Stress component {} per unit of strain component {} (engineering shear strain){}.",
                        e.row() + 1, e.column() + 1, needed ? "" : "; 0 in orthotropic materials"),
            {.required = needed, .unit = "Pa", .range = e.diagonal() ? kPositive : Range{}});
    }
    s.key("repair", &A::repair_,
          "Treatment of constants that make the material unstable. none: refuse them. shrink: multiply all constants "
          "off the diagonal by the largest factor that makes it stable, with a warning.");
    s.check([](const A& a, const Config& config) {
      if (is_stable(a.given())) return;
      if (a.repair_ == RatioRepair::none) config.fail(a.explained());
      for (const Entry& e : entries())
        if (!e.diagonal() && a.*e.value != 0) config.fill(e.name, number_text(a.factor() * (a.*e.value)));
    });
    return s;
  }

  // The given constants in the Voigt order of stiffness.h.
  AnisotropicStiffness given() const {
    constexpr std::array<int, 6> usual{0, 1, 2, 4, 5, 3}, ours{0, 1, 2, 3, 4, 5}, abaqus{0, 1, 2, 3, 5, 4};
    const auto& place = order_ == VoigtOrder::s23_13_12 ? usual : order_ == VoigtOrder::abaqus ? abaqus : ours;
    AnisotropicStiffness C;
    for (const Entry& e : entries()) {
      const int i = place[static_cast<std::size_t>(e.row())], j = place[static_cast<std::size_t>(e.column())];
      C.c(i, j) = C.c(j, i) = this->*e.value;
    }
    return C;
  }

  double factor() const { return stabilising_factor(given()); }
  AnisotropicStiffness used() const { return is_stable(given()) ? given() : shrink_couplings(given(), factor()); }

  std::string couplings(double factor, const char* each) const {
    std::vector<std::string> parts;
    for (const Entry& e : entries())
      if (!e.diagonal() && this->*e.value != 0)
        parts.push_back(fmt::format(fmt::runtime(each), e.name, factor * (this->*e.value)));
    return fmt::format("{}", fmt::join(parts, ", "));
  }

  std::string explained() const {
    return fmt::format(
        "the constants make the stiffness indefinite: {}. Nearest stable set (all constants off the diagonal times "
        "{:.4g}): {}. Or set repair: shrink.",
        describe_softest_strain(given()), factor(), couplings(factor(), "{}: {:.6g}"));
  }

  VoigtOrder order_ = VoigtOrder::s23_13_12;
  double c11_ = 0, c12_ = 0, c13_ = 0, c14_ = 0, c15_ = 0, c16_ = 0, c22_ = 0, c23_ = 0, c24_ = 0, c25_ = 0, c26_ = 0,
         c33_ = 0, c34_ = 0, c35_ = 0, c36_ = 0, c44_ = 0, c45_ = 0, c46_ = 0, c55_ = 0, c56_ = 0, c66_ = 0;
  RatioRepair repair_ = RatioRepair::none;
};

const bool anisotropic_registered = Registry<Material>::add<Anisotropic>(
    "anisotropic",
    "All 21 constants c11 to c66 of the stiffness; those that are 0 in orthotropic materials default to 0.");

}  // namespace
}  // namespace orthodyn
