// The named materials: some values checked by hand, and conditions that all of them must satisfy.
#include "lib/material/presets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lib/material/material.h"
#include "tests/config/messages.h"
#include "tests/material/constants.h"

namespace orthodyn::presets_test {
namespace {

std::shared_ptr<const Material> read(const std::string& yaml) {
  return Registry<Material>::read(Config::from_text(yaml, "a.yaml"));
}

const Preset& named(const std::string& name) {
  const auto it = std::find_if(presets().begin(), presets().end(), [&](const Preset& p) { return p.name == name; });
  EXPECT_NE(it, presets().end()) << name;
  return *it;
}

bool is_wood(const Preset& p) { return p.source.find("Wood Handbook") != std::string::npos; }

TEST(Presets, AreTwelveOfWhichTenAreWoods) {
  EXPECT_EQ(presets().size(), 12u);
  EXPECT_EQ(std::count_if(presets().begin(), presets().end(), is_wood), 10);
}

TEST(Presets, EachIsStableAndSaysItsSource) {
  for (const Preset& p : presets()) {
    EXPECT_TRUE(is_stable(p.constants)) << p.name;
    EXPECT_GT(p.source.size(), 20u) << p.name;
    EXPECT_FALSE(p.axes.empty()) << p.name;
  }
}

TEST(Presets, WoodsAreFarFromTheLimitOfStability) {
  for (const Preset& p : presets()) {
    if (!is_wood(p)) continue;
    const double lambda = rho_eigenvalues(p.constants)[0];
    EXPECT_GE(lambda, 0.3) << p.name;
    EXPECT_LE(lambda, 0.63) << p.name;
  }
}

// E1 = 11.88 GPa times 0.078 (E2), 0.043 (E3), 0.064 (g12), 0.061 (g13) and 0.003 (g23).
TEST(Presets, SitkaSpruceHasTheModuliOfTheTable) {
  const auto& c = named("sitka_spruce").constants;
  EXPECT_NEAR(c.young[0], 11.88e9, 1);
  EXPECT_NEAR(c.young[1], 0.92664e9, 1);
  EXPECT_NEAR(c.young[2], 0.51084e9, 1);
  EXPECT_NEAR(c.g12, 0.76032e9, 1);
  EXPECT_NEAR(c.g13, 0.72468e9, 1);
  EXPECT_NEAR(c.g23, 0.03564e9, 1);
  EXPECT_EQ(c.nu12, 0.372);
  EXPECT_EQ(c.nu13, 0.467);
  EXPECT_EQ(c.nu23, 0.435);
  EXPECT_EQ(named("sitka_spruce").density, 448);
}

// Walnut: E1 = 12.76 GPa times 0.106 (E2) and 0.021 (g23). Balsa: E1 = 3.74 GPa times 0.015 (E3).
TEST(Presets, WalnutAndBalsaHaveTheModuliOfTheTable) {
  EXPECT_NEAR(named("black_walnut").constants.young[1], 1.35256e9, 1);
  EXPECT_NEAR(named("black_walnut").constants.g23, 0.26796e9, 1);
  EXPECT_NEAR(named("balsa").constants.young[2], 0.0561e9, 1);
  EXPECT_FALSE(named("balsa").density);
}

// The compliance, the inverse of C, must satisfy nu_ij / E_i = nu_ji / E_j.
TEST(Presets, HaveASymmetricComplianceWithTheRatiosOfTheTable) {
  for (const Preset& p : presets()) {
    const Mat6 S = voigt(stiffness(p.constants)).inverse();
    EXPECT_NEAR(-S(0, 1) / S(0, 0), p.constants.nu12, 1e-12) << p.name;
    EXPECT_NEAR(-S(1, 2) / S(1, 1), p.constants.nu23, 1e-12) << p.name;
    EXPECT_NEAR(-S(0, 2) / S(0, 0), p.constants.nu13, 1e-12) << p.name;
    EXPECT_NEAR(S(0, 1), S(1, 0), 1e-12 * std::abs(S(0, 0))) << p.name;
  }
}

TEST(PresetMaterial, IsTheOrthotropicMaterialOfItsConstants) {
  const auto material = read("{type: preset, name: sitka_spruce}");
  EXPECT_EQ(voigt(material->stiffness()), voigt(stiffness(named("sitka_spruce").constants)));
  EXPECT_EQ(material->density(), 448);
}

TEST(PresetMaterial, TakesADensityOfItsOwn) {
  EXPECT_EQ(read("{type: preset, name: sitka_spruce, density: 410}")->density(), 410);
  EXPECT_EQ(read("{type: preset, name: balsa, density: 160}")->density(), 160);
}

TEST(PresetMaterial, WithoutAMeasuredDensityAsksForOne) {
  for (const Preset& p : presets()) {
    const std::string message = refusal([&] { read(fmt::format("{{type: preset, name: {}}}", p.name)); });
    if (p.density) EXPECT_EQ(message, "accepted") << p.name;
    else EXPECT_TRUE(holds(message, "'density' is missing: " + p.name + " has no measured density"));
  }
}

TEST(PresetMaterial, SpellsOutItsDensityInTheResolvedInput) {
  const Config config = Config::from_text("{type: preset, name: douglas_fir}").resolving();
  Registry<Material>::read(config);
  EXPECT_EQ(config.at("density").number(), 537.6);
}

TEST(PresetMaterial, OfAnUnknownNameIsRefusedWithTheNearest) {
  EXPECT_TRUE(holds(refusal([] { read("{type: preset, name: sitka_sprouce}"); }), "did you mean 'sitka_spruce'?"));
}

}  // namespace
}  // namespace orthodyn::presets_test
