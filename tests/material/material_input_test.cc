// Input of materials: accepted values, refused values, and the advice in the messages.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "lib/material/material.h"
#include "tests/config/messages.h"
#include "tests/material/constants.h"

namespace orthodyn::material_input_test {
namespace {

std::shared_ptr<const Material> read(const std::string& yaml) {
  return Registry<Material>::read(Config::from_text(yaml, "a.yaml"));
}

OrthotropicStiffness stiffness_of(const std::string& yaml) {
  return std::get<OrthotropicStiffness>(read(yaml)->stiffness());
}

std::string refusal_of(const std::string& yaml) {
  return refusal([&] { read(yaml); });
}

std::string orthotropic(const std::string& ratios, const std::string& young = "[10.8, 0.84, 0.46]") {
  return "{type: orthotropic, density: 400, young: " + young + ", g12: 0.69, g23: 0.032, g13: 0.66, " + ratios + "}";
}

TEST(Material, HasTheDensityGiven) {
  EXPECT_EQ(read("{type: isotropic, density: 7800, young: 1, nu: 0.3}")->density(), 7800);
}

TEST(Material, IsotropicHasTheLameConstants) {
  const auto C = std::get<IsotropicStiffness>(read("{type: isotropic, density: 1, young: 5, nu: 0.25}")->stiffness());
  EXPECT_DOUBLE_EQ(C.lambda, 2);
  EXPECT_DOUBLE_EQ(C.mu, 2);
}

TEST(Material, OrthotropicIsTheStiffnessOfItsConstants) {
  const auto C = stiffness_of(orthotropic("nu12: 0.44, nu23: 0.44, nu31: 0.0225"));
  EXPECT_LE((voigt(C) - voigt(stiffness(spruce()))).cwiseAbs().maxCoeff(), 8 * kEps * C.c11);
}

TEST(Material, ARatioOrItsReverseDescribeTheSameMaterial) {
  const Mat6 forward = voigt(stiffness_of(orthotropic("nu12: 0.44, nu23: 0.44, nu13: 0.5")));
  const std::string reverse =
      fmt::format("nu21: {}, nu32: {}, nu31: {}", 0.44 * 0.84 / 10.8, 0.44 * 0.46 / 0.84, 0.5 * 0.46 / 10.8);
  EXPECT_LE((voigt(stiffness_of(orthotropic(reverse))) - forward).cwiseAbs().maxCoeff(), 8 * kEps * forward.norm());
}

TEST(MaterialRefuses, ARatioTogetherWithItsReverse) {
  EXPECT_TRUE(holds(refusal_of(orthotropic("nu12: 0.44, nu21: 0.03, nu23: 0.44, nu13: 0.5")),
                    "nu12 and nu21 are the same constant"));
}

TEST(MaterialRefuses, AMissingPair) {
  EXPECT_TRUE(
      holds(refusal_of(orthotropic("nu12: 0.44, nu23: 0.44")), "a Poisson's ratio is missing: give nu13 or nu31"));
}

TEST(MaterialRefuses, RatiosAtOrBeyondTheLimitsOfTheFamily) {
  for (const char* type : {"isotropic, young: 1", "orthotropic_stable, young: [3, 2, 1]"})
    for (const char* nu : {"0.5", "0.500000000001", "-1", "-1.5"})
      EXPECT_TRUE(holds(refusal_of(fmt::format("{{type: {}, density: 1, nu: {}}}", type, nu)),
                        fmt::format("nu: must be in (-1, 0.5), found {}", nu)));
}

TEST(MaterialRefuses, ModuliThatAreNotPositive) {
  for (const char* E : {"0", "-1"}) {
    EXPECT_TRUE(holds(refusal_of(fmt::format("{{type: isotropic, density: 1, nu: 0, young: {}}}", E)),
                      fmt::format("young: must be > 0 Pa, found {}", E)));
    EXPECT_TRUE(holds(refusal_of(orthotropic("nu12: 0, nu23: 0, nu13: 0", fmt::format("[1, {}, 1]", E))),
                      "young.1: must be > 0 Pa"));
  }
  EXPECT_TRUE(holds(refusal_of("{type: isotropic, density: 0, nu: 0, young: 1}"), "density: must be > 0 kg/m^3"));
}

TEST(MaterialRefuses, NumbersThatAreNotFinite) {
  EXPECT_TRUE(holds(refusal_of(orthotropic("nu12: nan, nu23: 0, nu13: 0")), "nu12: expected a finite number"));
  EXPECT_TRUE(holds(refusal_of(orthotropic("nu12: 0, nu23: 0, nu13: 0", "[inf, 1, 1]")), "young.0: expected a finite"));
}

// Spruce with one modulus in the wrong unit, and with E1 and E3 exchanged.
TEST(MaterialRefuses, UnstableSetsWhoseModuliAreToBlame) {
  const std::string ratios = "nu12: 0.44, nu23: 0.44, nu13: 0.53";
  EXPECT_TRUE(holds(refusal_of(orthotropic(ratios, "[10.8e6, 0.84e9, 0.46e9]")),
                    "Is E1 = 1.08e+07 Pa in the same unit as the other two, 8.4e+08 and 4.6e+08 Pa? With 1.08e+10 Pa "
                    "the material is stable. Otherwise nu12=0.44, "));
  EXPECT_TRUE(holds(refusal_of(orthotropic(ratios, "[0.46e9, 0.84e9, 10.8e9]")),
                    "Are the moduli in the order of the axes 1, 2, 3? With 1.08e+10, 8.4e+08, 4.6e+08 Pa"));
  EXPECT_FALSE(holds(refusal_of(orthotropic("nu12: 0.44, nu23: 1.7, nu13: 0.53", "[10.8e9, 0.84e9, 0.46e9]")), "Is E"));
}

// USDA Wood Handbook (FPL-GTR-282), tables 5-1 and 5-2: L = axis 1, R = 2, T = 3; moduli over E_L.
struct Wood {
  const char* name;
  double E_R, E_T, nu_LR, nu_LT, nu_RT;
  std::string moduli() const { return fmt::format("[1, {}, {}]", E_R, E_T); }
};
const std::vector<Wood> kWoods{
    {"sitka spruce", 0.078, 0.043, 0.372, 0.467, 0.435},     {"douglas fir", 0.068, 0.050, 0.292, 0.449, 0.390},
    {"engelmann spruce", 0.128, 0.059, 0.422, 0.462, 0.530}, {"yellow poplar", 0.092, 0.043, 0.318, 0.392, 0.703},
    {"yellow birch", 0.078, 0.050, 0.426, 0.451, 0.697},     {"black walnut", 0.106, 0.056, 0.495, 0.632, 0.718},
    {"sweetgum", 0.115, 0.050, 0.325, 0.403, 0.682},         {"balsa", 0.046, 0.015, 0.229, 0.488, 0.665},
    {"honduras mahogany", 0.107, 0.064, 0.314, 0.533, 0.600}};

TEST(Material, MeasuredWoodReadCorrectlyIsAccepted) {
  for (const Wood& w : kWoods)
    EXPECT_EQ(
        refusal_of(orthotropic(fmt::format("nu12: {}, nu13: {}, nu23: {}", w.nu_LR, w.nu_LT, w.nu_RT), w.moduli())),
        "accepted")
        << w.name;
}

TEST(MaterialRefuses, WoodWhoseNu13StandsInThePlaceOfNu31) {
  for (const Wood& w : kWoods) {
    const std::string message =
        refusal_of(orthotropic(fmt::format("nu12: {}, nu31: {}, nu23: {}", w.nu_LR, w.nu_LT, w.nu_RT), w.moduli()));
    EXPECT_TRUE(starts(message, "a.yaml:1:1: ")) << w.name;
    EXPECT_TRUE(holds(message, "|nu31| < sqrt(E3/E1)")) << w.name;
    EXPECT_TRUE(holds(message, "is violated")) << w.name;
  }
}

TEST(MaterialRefuses, RatiosThatAreUnstableOnlyTogether) {
  const std::string message = refusal_of(orthotropic("nu12: 0.8, nu23: 0.8, nu13: 0.8", "[1, 1, 1]"));
  EXPECT_TRUE(holds(message, "1 - nu12 nu21 - nu23 nu32 - nu31 nu13 - 2 nu12 nu23 nu31 > 0 is violated: it is -1.944"));
}

// The number after `marker` in the message; NaN if `marker` is absent.
double number_after(const std::string& message, const std::string& marker) {
  const auto at = message.find(marker);
  return at == std::string::npos ? std::nan("") : std::stod(message.substr(at + marker.size()));
}

TEST(MaterialRefuses, UnstableSetsWithASetThatIsAccepted) {
  Random random(19);
  int refused = 0;
  for (int sample = 0; sample < 300; ++sample) {
    const Vec3 r = 1.5 * random.vector();
    const auto c = with_scaled_ratios({10.8, 0.84, 0.46}, r);
    const std::string message =
        refusal_of(orthotropic(fmt::format("nu12: {}, nu23: {}, nu13: {}", c.nu12, c.nu23, c.nu13)));
    if (message == "accepted") continue;
    ++refused;
    const std::string marker = "Nearest stable set (all ratios times ";
    const auto at = message.find("nu12: ", message.find(marker));
    ASSERT_NE(at, std::string::npos) << message;
    EXPECT_EQ(refusal_of(orthotropic(message.substr(at, message.find(". Or", at) - at))), "accepted") << message;
  }
  EXPECT_GT(refused, 100);
}

TEST(MaterialRefuses, ARatioWithTheRangeThatIsAcceptedUpToItsEnds) {
  const auto with_nu13 = [](double nu13) { return orthotropic(fmt::format("nu12: 0.8, nu23: 0.5, nu13: {}", nu13)); };
  const std::string message = refusal_of(with_nu13(20));
  const std::string marker = "the other two ratios nu13 must lie in (";
  const double low = number_after(message, marker);
  const double high = number_after(message.substr(message.find(marker) + marker.size()), ", ");
  ASSERT_LT(low, high) << message;
  const double digits = 1e-3 * (high - low);  // larger than the rounding of the four printed digits
  EXPECT_EQ(refusal_of(with_nu13(low + digits)), "accepted");
  EXPECT_EQ(refusal_of(with_nu13(high - digits)), "accepted");
  EXPECT_NE(refusal_of(with_nu13(low - digits)), "accepted");
  EXPECT_NE(refusal_of(with_nu13(high + digits)), "accepted");
}

}  // namespace
}  // namespace orthodyn::material_input_test
