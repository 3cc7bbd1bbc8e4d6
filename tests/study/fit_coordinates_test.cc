// Coordinates of a fit: every point is a stable material, and every stable material is a point.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "lib/material/orthotropy.h"
#include "lib/study/fit/coordinates.h"

namespace orthodyn::study::fit {
namespace {

const char* const kScene = R"(
materials:
  wood: {type: orthotropic, density: 450, young: [10 GPa, 0.8 GPa, 0.5 GPa], nu12: 0.4, nu32: 0.2, nu13: 0.4,
         g12: 0.7 GPa, g23: 4e7, g13: 6e8}
  fibre: {type: transversely_isotropic, density: 450, young_axial: 40 GPa, young_transverse: 4 GPa, nu_axial: 0.3,
          nu_transverse: 0.4, shear_axial: 1 GPa}
)";

// Parameters with these paths: ratios and moduli.
Coordinates coordinates_of(const std::vector<std::string>& paths) {
  const Config scene = Config::from_text(kScene, "scene.yaml");
  Coordinates out;
  std::vector<PathOfParameter> all;
  for (const std::string& path : paths) {
    if (is_poisson_ratio(path, scene)) out.add_ratio();
    else out.add_log();
    all.push_back({all.size(), path, scene});
  }
  set_intervals(out, all);
  return out;
}

const std::vector<std::string> kNine{"materials.wood.young.0", "materials.wood.young.1", "materials.wood.young.2",
                                     "materials.wood.nu12",    "materials.wood.nu32",    "materials.wood.nu13"};

OrthotropicConstants constants_at(const Vector& values) {
  OrthotropicConstants out;
  out.young = values.head<3>();
  out.nu12 = values[3], out.nu23 = values[4] * values[1] / values[2], out.nu13 = values[5];
  return out;
}

TEST(FitCoordinates, AreAlwaysAStableMaterial) {
  const Coordinates coordinates = coordinates_of(kNine);
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 3);
  double smallest = 1;
  for (int trial = 0; trial < 2000; ++trial) {
    Vector z(6);
    for (double& x : z) x = normal(random);
    z.head<3>().array() += 20;
    const Vector values = coordinates.values(z);
    const OrthotropicConstants constants = constants_at(values);
    ASSERT_TRUE(is_stable(constants)) << values.transpose();
    smallest = std::min(smallest, rho_eigenvalues(constants)[0]);
    const Vector back = coordinates.at(values);
    for (Eigen::Index i = 0; i < 6; ++i) ASSERT_NEAR(back[i], z[i], 1e-4 * (1 + std::abs(z[i]))) << i;
  }
  EXPECT_LT(smallest, 1e-3);  // materials next to the limit of stability are reached
}

// Random stable materials, also with ratios above 1 and below 0.
TEST(FitCoordinates, ReachEveryStableMaterial) {
  const Coordinates coordinates = coordinates_of(kNine);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-3, 3);
  int stable = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Vector values(6);
    for (Eigen::Index i = 0; i < 3; ++i) values[i] = std::exp(20 + uniform(random));
    for (Eigen::Index i = 3; i < 6; ++i) values[i] = uniform(random);
    const Vector z = coordinates.at(values);
    ASSERT_EQ(z.allFinite(), is_stable(constants_at(values))) << values.transpose();
    if (!z.allFinite()) continue;
    ++stable;
    EXPECT_LT((coordinates.values(z) - values).cwiseQuotient(values).lpNorm<Eigen::Infinity>(), 1e-10);
  }
  EXPECT_GT(stable, 100);
}

TEST(FitCoordinates, HaveDerivativesThatAreLimitsOfDifferences) {
  for (const auto& paths :
       {kNine, std::vector<std::string>{"materials.wood.young.1", "materials.wood.nu12", "materials.wood.nu32"},
        std::vector<std::string>{"materials.fibre.young_axial", "materials.fibre.nu_axial",
                                 "materials.fibre.nu_transverse"}}) {
    const Coordinates coordinates = coordinates_of(paths);
    const auto n = static_cast<Eigen::Index>(paths.size());
    Vector z(n);
    for (Eigen::Index i = 0; i < n; ++i)
      z[i] = coordinates.is_ratio(static_cast<std::size_t>(i)) ? 0.6 - 0.4 * static_cast<double>(i) : 22;
    const Eigen::MatrixXd exact = coordinates.derivatives(z);
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto error = [&](double h) {
        Vector before = z, after = z;
        before[j] -= h, after[j] += h;
        return Vector((coordinates.values(after) - coordinates.values(before)) / (2 * h) - exact.col(j));
      };
      const Vector coarse = error(0.02), fine = error(0.01);
      for (Eigen::Index i = 0; i < n; ++i) {
        if (exact(i, j) == 0) EXPECT_EQ(coarse[i], 0) << paths[static_cast<std::size_t>(i)];
        else EXPECT_NEAR(std::log2(std::abs(coarse[i] / fine[i])), 2, 0.1) << paths[static_cast<std::size_t>(i)] << j;
      }
    }
  }
}

// With the other ratios fixed, the interval is the one that they leave.
TEST(FitCoordinates, OfOneRatioSpanTheIntervalThatTheOthersLeave) {
  const Coordinates coordinates = coordinates_of({"materials.wood.nu12"});
  OrthotropicConstants constants = constants_at((Vector(6) << 10e9, 0.8e9, 0.5e9, 0, 0.2, 0.4).finished());
  for (const double z : {-20.0, 20.0}) {
    const double nu = coordinates.values(Vector::Constant(1, z))[0];
    constants.nu12 = nu;
    EXPECT_TRUE(is_stable(constants)) << nu;
    constants.nu12 = nu + (z > 0 ? 1e-4 : -1e-4);
    EXPECT_FALSE(is_stable(constants)) << nu;
  }
}

TEST(FitCoordinates, OfTransverseIsotropyEndAtItsLimits) {
  const Coordinates both = coordinates_of({"materials.fibre.nu_axial", "materials.fibre.nu_transverse"});
  const Vector top = both.values(Vector::Constant(2, 20));
  EXPECT_NEAR(top[1], 1, 1e-5);
  const Vector middle = both.values((Vector(2) << 20, 0).finished());
  EXPECT_NEAR(1 - middle[1] - 2 * middle[0] * middle[0] * 4 / 40, 0, 1e-4);
  const Coordinates transverse = coordinates_of({"materials.fibre.nu_transverse"});
  EXPECT_NEAR(transverse.values(Vector::Constant(1, 20))[0], 1 - 2 * 0.09 * 0.1, 1e-5);
}

TEST(FitCoordinates, RefuseARatioThatIsGivenTwice) {
  Config scene = Config::from_text(kScene, "scene.yaml");
  scene.set_yaml("materials.wood.nu21", "0.03");
  Coordinates coordinates;
  coordinates.add_ratio();
  EXPECT_THROW(set_intervals(coordinates, {{0, "materials.wood.nu12", scene}}), ConfigError);
}

}  // namespace
}  // namespace orthodyn::study::fit
