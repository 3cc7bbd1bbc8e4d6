// Linear buckling against Euler, Engesser and the ring under pressure.
#include "lib/analysis/buckling.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/simulation/statics/static_problem.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::buckling_test {
namespace {

constexpr double kPi = std::numbers::pi;

// Twice the round-off times the condition number of the thinnest strip, h = 0.004: stiffness E A/(h/2) = 6e8 N/m of one
// element through the thickness over 12.4 E I/L^3 = 3 N/m in bending, times some 1,300 nodes.
constexpr double kResidual = 2 * 2.2e-16 * 6e8 / (3.0 / 1300);

double first_factor(const std::string& yaml) {
  const BuiltTestScene scene(yaml);
  const auto modes = buckling_modes(scene.model(), unloaded_shape(scene.scene, scene.built), 0, 1).modes;
  if (modes.empty()) return 0;
  EXPECT_LE(modes[0].residual, kResidual);
  return modes[0].load_factor;
}

// A strip of length 1, width 0.05 and thickness h in z, optionally extended beyond its end.
std::string strip(double h, double beyond, const std::string& clamps, const std::string& material) {
  return fmt::format(R"(
mesh: {{type: box, size: [{}, 0.05, {}], cells: [44, 1, 2]}}
materials: {{m: {}}}
clamps: {}
loads: [{{surface: x1, force: [-1, 0, 0]}}]
time: {{end: 1}}
)",
                     1 + beyond, h, material, clamps);
}

constexpr double kYoung = 1e9;
const std::string kIsotropicMaterial = "{type: isotropic, density: 1000, young: 1e9, nu: 0}";
double bending_stiffness(double h) { return kYoung * 0.05 * h * h * h / 12; }

// The centre line of an end face.
std::string pin(double x, double h, const std::string& components) {
  return fmt::format("{{box: {{min: [{0}, 0, {1}], max: [{0}, 0.05, {1}]}}, components: {2}}}", x, h / 2, components);
}

TEST(EulersColumn, HasItsFourCriticalLoads) {
  const double h = 0.004, pi2 = kPi * kPi;
  const std::string fixed = "{surface: x0}";
  // An extension of a tenth of the length that can only slide along x fixes the slope at the end.
  const std::string slides = "{box: {min: [1, 0, 0], max: [1.1, 0.05, 0.004]}, components: [y, z]}";
  const struct {
    const char* name;
    double beyond;
    std::string clamps;
    double expected;  // of E I / L^2
  } cases[] = {
      {"clamped, free", 0, "[" + fixed + "]", pi2 / 4},
      {"pinned, pinned", 0, "[" + pin(0, h, "[x, y, z]") + ", " + pin(1, h, "[z]") + "]", pi2},
      {"clamped, pinned", 0, "[" + fixed + ", " + pin(1, h, "[z]") + "]", 20.1907},  // tan k = k
      {"clamped, clamped", 0.1, "[" + fixed + ", " + slides + "]", 4 * pi2},
  };
  for (const auto& c : cases) {
    const double found = first_factor(strip(h, c.beyond, c.clamps, kIsotropicMaterial));
    EXPECT_NEAR(found / bending_stiffness(h), c.expected, 0.01 * c.expected) << c.name;
  }
}

// 1/P = 1/P_Euler + 1/(kappa G A) with kappa = 5/6 (Engesser 1891).
TEST(EngessersColumn, SoftInShearBucklesSooner) {
  const double h = 0.05, shear = 5e6;
  const std::string wood = fmt::format(
      "{{type: orthotropic, density: 400, young: [1e9, 1e9, 1e9], nu12: 0, nu23: 0, nu31: 0, g12: 5e8, g23: 5e8, g13: "
      "{}}}",
      shear);
  const double euler = kPi * kPi / 4 * bending_stiffness(h),
               expected = 1 / (1 / euler + 1 / (5.0 / 6 * shear * 0.05 * h));
  ASSERT_LT(expected, 0.9 * euler);
  EXPECT_NEAR(first_factor(strip(h, 0, "[{surface: x0}]", wood)), expected, 0.02 * expected);
}

// 3 E I/R^3 for pressure that stays normal to the ring (Bresse 1866), with the radius R of the axis; 4 E I/R^3 for
// pressure with a fixed direction.
TEST(Ring, UnderPressureThatFollowsItBucklesAsBresseFound) {
  const double outer = 1.01, inner = 0.99, width = 0.05, h = outer - inner;
  const double found = first_factor(fmt::format(R"(
mesh: {{type: tube, radius: {}, inner_radius: {}, length: {}, cells: [96, 1, 1]}}
materials: {{m: {}}}
clamps:
  - {{surface: end0, components: [z]}}
  - {{nearest: [1, 0, 0], components: [y]}}
  - {{nearest: [-1, 0, 0], components: [y]}}
  - {{nearest: [0, 1, 0], components: [x]}}
terms: [{{type: pressure, surface: outer, pressure: 1}}]
time: {{end: 1}}
)",
                                                outer, inner, width, kIsotropicMaterial));
  const double expected = 3 * kYoung * h * h * h / 12;  // R = 1
  EXPECT_NEAR(found, expected, 0.01 * expected);
}

TEST(Buckling, LoadDoesNotDependOnTheUnitLoad) {
  const std::string scene = strip(0.01, 0, "[{surface: x0}]", kIsotropicMaterial);
  const double expected = first_factor(scene);
  for (const double unit : {1e-8, 1e-3, 50.0}) {
    std::string other = scene;
    other.replace(other.find("[-1, 0, 0]"), 10, fmt::format("[{}, 0, 0]", -unit));
    EXPECT_NEAR(first_factor(other) * unit, expected, 1e-5 * expected) << unit;
  }
}

TEST(Buckling, HasNoFactorWhereTheLoadPulls) {
  std::string pulled = strip(0.01, 0, "[{surface: x0}]", kIsotropicMaterial);
  pulled.replace(pulled.find("[-1, 0, 0]"), 10, "[1, 0, 0]");
  EXPECT_EQ(first_factor(pulled), 0);
}

}  // namespace
}  // namespace orthodyn::buckling_test
