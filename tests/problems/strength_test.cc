// Stress, strain and failure exposures under uniform stress, as quantities.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/core/errors.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/statics/static_problem.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::strength_problem_test {
namespace {

constexpr double kPull = 1e6;  // Pa

// A block in tension along x with grain at -theta, supported statically determinately. With linear kinematics the
// stress is uniform and known.
std::string block(double degrees, const std::string& strength) {
  const double theta = degrees * std::numbers::pi / 180;
  return fmt::format(R"(
analysis: static
elasticity: {{kinematics: linear}}
mesh: {{type: box, size: [1, 0.5, 0.4], cells: [3, 2, 2]}}
materials:
  wood: {{type: orthotropic, density: 400, young: [10.8e9, 0.84e9, 0.46e9], nu12: 0.44, nu23: 0.44, nu31: 0.0225,
         g12: 0.69e9, g23: 0.032e9, g13: 0.66e9{0}}}
regions: {{all: {{material: wood, axes: {{first: [{1}, -{2}, 0], second: [{2}, {1}, 0]}}}}}}
clamps:
  - {{nearest: [0, 0, 0]}}
  - {{nearest: [1, 0, 0], components: [y, z]}}
  - {{nearest: [0, 0.5, 0], components: [z]}}
loads: [{{surface: x0, traction: [-{3}, 0, 0]}}, {{surface: x1, traction: [{3}, 0, 0]}}]
output: {{probes: {{middle: {{at: [0.5, 0.25, 0.2]}}}}}}
)",
                     strength, std::cos(theta), std::sin(theta), kPull);
}

const std::string kStrength =
    ", strength: {tension: [70e6, 2.6e6, 2.6e6], compression: [38e6, 4e6, 4e6], shear: [7.9e6, 1.4e6, 7.9e6]}";

class Pulled {
 public:
  explicit Pulled(double degrees, const std::string& strength = kStrength)
      : scene_(block(degrees, strength)), q_(equilibrium(scene_.scene, scene_.built)) {}

  double operator()(const std::string& quantity) const {
    const State state{0, q_, Vector::Zero(q_.size())};
    return find_quantity(quantity, scene_.scene, scene_.model(), {"test"}).values({scene_.model(), state})[0];
  }

 private:
  BuiltTestScene scene_;
  Vector q_;
};

TEST(UniformStress, IsKnownAtAPointAndOverTheBody) {
  for (const double degrees : {0.0, 30.0, 90.0}) {
    const Pulled body(degrees);
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    const struct {
      const char* quantity;
      double expected;
    } known[] = {{"middle.nodal_stress.xx", kPull},
                 {"middle.nodal_stress_material.11", kPull * c * c},
                 {"middle.nodal_stress_material.22", kPull * s * s},
                 {"middle.nodal_stress_material.12", kPull * c * s},
                 {"nodal_stress_material.22.largest", kPull * s * s},
                 {"body.nodal_stress_material.22.smallest", kPull * s * s},
                 {"von_mises.largest", kPull},
                 {"middle.von_mises", kPull},
                 {"middle.principal_stress.1", kPull},
                 {"middle.principal_stress.3", 0}};
    for (const auto& [quantity, expected] : known)
      EXPECT_NEAR(body(quantity), expected, 1e-4 * kPull) << quantity << " at " << degrees;
    // Strain in global axes: eps_xx = sigma/E_x.
    const double Exx =
        1 / (std::pow(c, 4) / 10.8e9 + std::pow(s, 4) / 0.84e9 + (1 / 0.69e9 - 2 * 0.44 / 10.8e9) * s * s * c * c);
    EXPECT_NEAR(body("middle.nodal_strain_space.xx"), kPull / Exx, 1e-4 * kPull / Exx) << degrees;
  }
}

// Uniaxial stress across the grain at an angle: sigma_1 = c^2, sigma_2 = s^2, tau_12 = c s times it.
TEST(UniformStress, HasTheExposuresOfTheCriteria) {
  const double X = 70e6, Xc = 38e6, Y = 2.6e6, Yc = 4e6, S = 7.9e6;
  for (const double degrees : {0.0, 15.0, 45.0, 90.0}) {
    const Pulled body(degrees);
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    const double s1 = kPull * c * c, s2 = kPull * s * s, t = kPull * c * s;
    EXPECT_NEAR(body("max_stress.largest"), std::max({s1 / X, s2 / Y, t / S}), 1e-5) << degrees;
    const double linear = (1 / X - 1 / Xc) * s1 + (1 / Y - 1 / Yc) * s2;
    const double quadratic =
        s1 * s1 / (X * Xc) + s2 * s2 / (Y * Yc) + t * t / (S * S) - s1 * s2 / std::sqrt(X * Xc * Y * Yc);
    EXPECT_NEAR(body("tsai_wu.largest"), (linear + std::sqrt(linear * linear + 4 * quadratic)) / 2, 1e-5) << degrees;
    const double matrix = std::sqrt(s2 * s2 / (Y * Y) + t * t / (S * S)), fibre = std::hypot(s1 / X, t / S);
    EXPECT_NEAR(body("middle.hashin"), std::max(matrix, fibre), 1e-5) << degrees;
  }
}

TEST(Exposures, NeedStrengths) {
  const BuiltTestScene scene(block(0, ""));
  try {
    find_quantity("tsai_wu.largest", scene.scene, scene.model(), {"here"});
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("needs the strengths"), std::string::npos) << e.what();
  }
}

TEST(Exposures, NeedStrengthsAtAProbe) {
  const BuiltTestScene scene(block(0, ""));
  try {
    find_quantity("middle.tsai_wu", scene.scene, scene.model(), {"here"});
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("the material of region body"), std::string::npos) << e.what();
  }
}

// A laminate whose middle ply is one linear element thick, so that each of its nodes also belongs to another ply. Under
// uniform strain along x (nu = 0) the stress of each ply is E times the strain.
TEST(ExtremesOfTheBody, AreNotAveragedAcrossRegions) {
  constexpr double kStiff = 10e9, kSoft = 1e9, kStretch = 1e-3;
  const BuiltTestScene scene(fmt::format(R"(
analysis: static
elasticity: {{kinematics: linear}}
mesh: {{type: box, size: [1, 0.5, 0.3], cells: [3, 2, 3], order: 1, parts: {{ply: {{min: [0, 0, 0.1], max: [1, 0.5, 0.2]}}}}}}
materials:
  stiff: {{type: isotropic, density: 400, young: {}, nu: 0}}
  soft: {{type: isotropic, density: 400, young: {}, nu: 0}}
regions: {{ply: {{material: stiff}}, all: {{material: soft}}}}
clamps: [{{surface: x0}}]
)",
                                         kStiff, kSoft));
  const Vector q = scene.dofs([&](const Vec3& x) { return Vec3(kStretch * x[0], 0, 0); });
  const State state{0, q, Vector::Zero(q.size())};
  const auto value = [&](const std::string& quantity) {
    return find_quantity(quantity, scene.scene, scene.model(), {"test"}).values({scene.model(), state})[0];
  };
  EXPECT_NEAR(value("nodal_stress.xx.largest"), kStiff * kStretch, 1e-9 * kStiff);
  EXPECT_NEAR(value("nodal_stress.xx.smallest"), kSoft * kStretch, 1e-9 * kStiff);
  EXPECT_NEAR(value("principal_stress.1.smallest"), kSoft * kStretch, 1e-9 * kStiff);
  EXPECT_NEAR(value("ply.von_mises.smallest"), kStiff * kStretch, 1e-9 * kStiff);
}

TEST(Quantities, AskForAComponentOfATensor) {
  const BuiltTestScene scene(block(0, kStrength));
  const Quantity whole = find_quantity("middle.nodal_stress", scene.scene, scene.model(), {"here"});
  EXPECT_EQ(whole.components(), 6);
  EXPECT_NE(whole.ask_for_component().find(".xx, .yy, .zz, .xy, .yz, .zx"), std::string::npos);
}

}  // namespace
}  // namespace orthodyn::strength_problem_test
