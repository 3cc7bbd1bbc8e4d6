// Repairs on request (repair, symmetrise): the constants used, the notes, and the resolved input.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "lib/material/material.h"
#include "lib/material/orthotropy.h"
#include "tests/config/messages.h"
#include "tests/material/constants.h"

namespace orthodyn::repair_test {
namespace {

std::shared_ptr<const Material> read(const std::string& yaml) {
  return Registry<Material>::read(Config::from_text(yaml, "a.yaml"));
}
Mat6 stiffness_of(const std::string& yaml) { return voigt(read(yaml)->stiffness()); }

std::string orthotropic(const std::string& more) {
  return "{type: orthotropic, density: 400, young: [10.8, 0.84, 0.46], g12: 0.69, g23: 0.032, g13: 0.66, " + more + "}";
}

const std::string kUnstable = "nu12: 0.3, nu23: 0.3, nu31: 0.3";  // 0.3 is given for nu31 instead of nu13

OrthotropicConstants unstable_constants() {
  OrthotropicConstants c = spruce();
  c.nu12 = c.nu23 = 0.3;
  c.nu13 = 0.3 * 10.8 / 0.46;
  return c;
}

TEST(Repair, MustBeAskedFor) {
  EXPECT_TRUE(holds(refusal([] { read(orthotropic(kUnstable)); }), "Or set repair: shrink."));
}

TEST(Repair, ShrinksAnUnstableSetToTheMarginAndSaysSo) {
  const auto c = unstable_constants();
  const double s = stabilising_factor(c);
  ASSERT_LT(s, 1);
  const std::string yaml = orthotropic(kUnstable + ", repair: shrink");
  EXPECT_LE((stiffness_of(yaml) - voigt(stiffness(shrink_ratios(c, s)))).norm(), 1e-13 * stiffness_of(yaml).norm());
  const auto notes = read(yaml)->notes();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(holds(notes[0], "nu12=0.3, nu23=0.3, nu31=0.3 make the stiffness indefinite"));
  EXPECT_TRUE(holds(notes[0], fmt::format("multiplied by {:.4g}, used are nu12={:.6g}", s, 0.3 * s)));
}

TEST(Repair, LeavesAStableSetAloneAndSaysNothing) {
  const std::string stable = "nu12: 0.44, nu23: 0.44, nu31: 0.0225";
  EXPECT_EQ(stiffness_of(orthotropic(stable + ", repair: shrink")), stiffness_of(orthotropic(stable)));
  EXPECT_TRUE(read(orthotropic(stable + ", repair: shrink"))->notes().empty());
}

TEST(Repair, IsSpelledOutInTheResolvedInputWhichIsStableItself) {
  const Config config = Config::from_text(orthotropic(kUnstable + ", repair: shrink")).resolving();
  const Mat6 used = voigt(Registry<Material>::read(config)->stiffness());
  const auto again = read(config.dump());
  EXPECT_TRUE(again->notes().empty());
  EXPECT_LE((voigt(again->stiffness()) - used).norm(), 1e-13 * used.norm());
  EXPECT_NEAR(config.at("nu31").number(), 0.3 * stabilising_factor(unstable_constants()), 1e-15);
}

TEST(Symmetrise, UsesTheMeanOfBothReadings) {
  // By symmetry nu12 = 0.4 requires nu21 = 0.4 * 0.84 / 10.8. The given nu21 is 10 % larger, so the mean is nu12 =
  // 0.42.
  const double nu21 = 1.1 * 0.4 * 0.84 / 10.8;
  const std::string yaml =
      orthotropic(fmt::format("nu12: 0.4, nu21: {}, nu23: 0.44, nu31: 0.0225, symmetrise: true", nu21));
  OrthotropicConstants mean = spruce();
  mean.nu12 = 0.42;
  EXPECT_LE((stiffness_of(yaml) - voigt(stiffness(mean))).norm(), 1e-13 * stiffness_of(yaml).norm());
  const auto notes = read(yaml)->notes();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(holds(notes[0], "nu12/E1 and nu21/E2 differ by 9.52 % of their mean"));  // 0.1 / 1.05
  EXPECT_TRUE(holds(notes[0], "nu12=0.42"));
}

TEST(Symmetrise, MustBeAskedForAndIsSpelledOut) {
  const std::string both = "nu12: 0.4, nu21: 0.04, nu23: 0.44, nu31: 0.0225";
  EXPECT_TRUE(holds(refusal([&] { read(orthotropic(both)); }), "give one, or symmetrise: true"));
  const Config config = Config::from_text(orthotropic(both + ", symmetrise: true")).resolving();
  const Mat6 used = voigt(Registry<Material>::read(config)->stiffness());
  EXPECT_NEAR(config.at("nu12").number() / 10.8, config.at("nu21").number() / 0.84, 1e-16);
  EXPECT_LE((stiffness_of(config.dump()) - used).norm(), 1e-13 * used.norm());
}

TEST(Symmetrise, GoesBeforeTheRepair) {
  const std::string yaml =
      orthotropic("nu12: 5, nu21: 0.3, nu23: 0.44, nu31: 0.0225, symmetrise: true, repair: shrink");
  EXPECT_EQ(read(yaml)->notes().size(), 2u);
  EXPECT_GT(symmetric_eigenvalues(stiffness_of(yaml))[0], 0);
}

}  // namespace
}  // namespace orthodyn::repair_test
