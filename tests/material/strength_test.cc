// Failure exposures compared with closed forms of the criteria.
#include "lib/material/strength.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/material/presets.h"
#include "tests/material/constants.h"

namespace orthodyn::strength_test {
namespace {

const Strength kWood{Vec3(70, 2.6, 3.1), Vec3(38, 4.0, 4.5), Vec3(7.9, 1.4, 8.3)};

using Exposure = double (*)(const Vec6&, const Strength&);
const Exposure kAll[] = {max_stress_exposure, tsai_wu_exposure, hashin_exposure};

Vec6 one(int component, double value) {
  Vec6 s = Vec6::Zero();
  s[component] = value;
  return s;
}

TEST(Exposure, IsOneAtEachStrengthByMaximumStressAndTsaiWu) {
  for (const Exposure exposure : {max_stress_exposure, tsai_wu_exposure})
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(exposure(one(i, kWood.tension[i]), kWood), 1, 1e-14) << i;
      EXPECT_NEAR(exposure(one(i, -kWood.compression[i]), kWood), 1, 1e-14) << i;
      EXPECT_NEAR(exposure(one(3 + i, -kWood.shear[i]), kWood), 1, 1e-14) << i;
    }
}

TEST(Exposure, OfAStressThatIsNotFiniteIsNotANumber) {
  for (const Exposure exposure : kAll)
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(std::isnan(exposure(one(i, std::nan("")), kWood))) << i;
}

// Hashin's criterion treats the axes 2 and 3 alike, both with the strengths of axis 2.
TEST(Exposure, IsOneAtEachStrengthByHashin) {
  EXPECT_NEAR(hashin_exposure(one(0, kWood.tension[0]), kWood), 1, 1e-14);
  EXPECT_NEAR(hashin_exposure(one(0, -kWood.compression[0]), kWood), 1, 1e-14);
  for (const int across : {1, 2}) {
    EXPECT_NEAR(hashin_exposure(one(across, kWood.tension[1]), kWood), 1, 1e-14);
    EXPECT_NEAR(hashin_exposure(one(across, -kWood.compression[1]), kWood), 1, 1e-14);
  }
  EXPECT_NEAR(hashin_exposure(one(3, kWood.shear[0]), kWood), 1, 1e-14);
  EXPECT_NEAR(hashin_exposure(one(5, kWood.shear[0]), kWood), 1, 1e-14);
  EXPECT_NEAR(hashin_exposure(one(4, kWood.shear[1]), kWood), 1, 1e-14);
}

TEST(Exposure, GrowsInProportionToTheStress) {
  Random random(51);
  for (int sample = 0; sample < 50; ++sample) {
    Vec6 s;
    for (double& x : s) x = 10 * random.vector()[0];
    for (const Exposure exposure : kAll)
      EXPECT_NEAR(exposure(3 * s, kWood), 3 * exposure(s, kWood), 1e-12 * (1 + exposure(s, kWood)));
  }
}

TEST(Exposure, IsNoneWithoutStress) {
  for (const Exposure exposure : kAll) EXPECT_EQ(exposure(Vec6::Zero(), kWood), 0);
}

// A stress scaled to an exposure of 1 must satisfy the original equation of Tsai and Wu.
TEST(TsaiWu, IsMetAtTheScaledStress) {
  Random random(52);
  for (int sample = 0; sample < 50; ++sample) {
    Vec6 s;
    for (double& x : s) x = 10 * random.vector()[0];
    s /= tsai_wu_exposure(s, kWood);
    double sum = 0;
    const Vec3 &X = kWood.tension, &Y = kWood.compression;
    for (int i = 0; i < 3; ++i) {
      sum += (1 / X[i] - 1 / Y[i]) * s[i] + s[i] * s[i] / (X[i] * Y[i]) + std::pow(s[3 + i] / kWood.shear[i], 2);
      for (int j = 0; j < 3; ++j)
        if (i != j) sum -= 0.5 / std::sqrt(X[i] * Y[i] * X[j] * Y[j]) * s[i] * s[j];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(Presets, OfTheWoodHandbooksWoodsHaveStrengths) {
  int with = 0;
  for (const Preset& preset : presets())
    if (preset.strength) {
      ++with;
      // Wood is strongest along the grain, where it is weaker in compression than in tension.
      EXPECT_GT(preset.strength->tension[0], preset.strength->compression[0]) << preset.name;
      EXPECT_GT(preset.strength->compression[0], 5 * preset.strength->compression[1]) << preset.name;
    }
  EXPECT_EQ(with, 7);
}

}  // namespace
}  // namespace orthodyn::strength_test
