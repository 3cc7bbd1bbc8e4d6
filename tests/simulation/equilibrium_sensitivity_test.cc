// Derivatives of equilibria with respect to numbers of a scene, against closed forms and repeated analyses.
#include "lib/simulation/sensitivity/equilibrium_sensitivity.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/core/errors.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn::equilibrium_sensitivity_test {
namespace {

struct Equilibrium {
  explicit Equilibrium(const Config& scene) : setup(set_up(scene)), problem(static_problem(setup.scene, setup.built)) {
    while (!problem.stepper->done()) problem.stepper->step();
    const State at = problem.stepper->state();
    state = {problem.path->times().end, at.q, at.v};
  }
  explicit Equilibrium(const std::string& scene) : Equilibrium(Config::from_text(scene, "scene.yaml")) {}

  double value(const std::string& quantity) const {
    return find_quantity(quantity, setup.scene, *setup.built.model, {})
        .values(ObservedState(*setup.built.model, state))
        .at(0);
  }
  double derivative(const std::string& path, const std::string& quantity) const {
    return EquilibriumSensitivity(setup.config, setup.scene, *setup.built.model, *problem.path, state)
        .derivatives(SceneParameter(setup.config, path),
                     named_quantities({quantity}, setup.scene, *setup.built.model))[0];
  }

  Setup setup;
  StaticProblem problem;
  State state;
};

// A bar under tension: u = F L / (E A), its energy F u / 2, the reaction -F.
TEST(EquilibriumSensitivity, OfABarIsThatOfItsClosedForms) {
  const Equilibrium bar(std::string(R"(
analysis: static
mesh: {type: box, size: [0.5, 0.1, 0.2], cells: [2, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1 GPa, nu: 0}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [100, 0, 0]}]
output: {reactions: true, probes: {end: {at: [0.5, 0, 0]}}}
)"));
  const double u = 100 * 0.5 / (1e9 * 0.02);
  ASSERT_NEAR(bar.value("end.displacement.x"), u, 1e-9 * u);
  const struct {
    const char *path, *quantity;
    double expected;
  } cases[] = {
      {"materials.m.young", "end.displacement.x", -u / 1e9},  {"loads.0.force.0", "end.displacement.x", u / 100},
      {"mesh.size.0", "end.displacement.x", u / 0.5},         {"mesh.size.2", "end.displacement.x", -u / 0.2},
      {"materials.m.young", "energy.elastic", -50 * u / 1e9}, {"loads.0.force.0", "energy.elastic", u},
      {"loads.0.force.0", "reaction.clamp_1.x", -1},          {"mesh.size.0", "energy.elastic", 50 * u / 0.5}};
  for (const auto& c : cases)
    EXPECT_NEAR(bar.derivative(c.path, c.quantity), c.expected, 1e-8 * std::abs(c.expected))
        << c.path << " " << c.quantity;
  EXPECT_NEAR(bar.derivative("materials.m.young", "reaction.clamp_1.x"), 0, 1e-8 * 100 / 1e9);
}

// Of a free bar that swells: u = a change L.
TEST(EquilibriumSensitivity, OfSwellingIsThatOfItsClosedForm) {
  const Equilibrium bar(std::string(R"(
analysis: static
mesh: {type: box, size: [0.5, 0.1, 0.2], cells: [2, 1, 1], order: 1}
materials:
  m: {type: isotropic, density: 1000, young: 1 GPa, nu: 0.3, expansion: {moisture: 1e-3, temperature: 2e-5},
      viscoelastic: [{time: 1, share: 0.4}]}
moisture: {change: 4}
temperature: {change: -50}
clamps: [{surface: x0, components: [x]}, {nearest: [0, 0, 0], components: [y, z]}, {nearest: [0, 0.1, 0], components: [z]}]
output: {probes: {end: {at: [0.5, 0, 0]}}}
)"));
  ASSERT_NEAR(bar.value("end.displacement.x"), 0.5 * (4e-3 - 1e-3), 1e-12);
  EXPECT_NEAR(bar.derivative("moisture.change", "end.displacement.x"), 0.5e-3, 1e-9);
  EXPECT_NEAR(bar.derivative("temperature.change", "end.displacement.x"), 1e-5, 1e-11);
  EXPECT_NEAR(bar.derivative("materials.m.expansion.moisture", "end.displacement.x"), 2, 1e-6);
  EXPECT_NEAR(bar.derivative("materials.m.young", "end.displacement.x"), 0, 1e-18);
}

// A strip with oblique grain that a following pressure bends by half its length.
const char* const kStrip = R"(
analysis: static
mesh: {type: box, size: [0.2, 0.03, 0.004], cells: [10, 2, 1], elements: hexahedra}
materials:
  wood: {type: orthotropic, density: 450, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 0.7e9, g23: 4e7, g13: 6e8}
regions: {body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 20 deg}}}
clamps: [{surface: x0}]
statics: {solver: {type: kinsol, rtol: 1e-12}}
terms: [{type: pressure, surface: z1, pressure: 20000}]
output: {probes: {tip: {at: [0.2, 0.03, 0.004], fields: [displacement, nodal_strain]}}}
)";

// Central differences of repeated analyses converge to the derivatives with order two.
TEST(EquilibriumSensitivity, AtLargeDisplacementsIsTheLimitOfDifferences) {
  constexpr double kRounding = 2e-5;  // of strains at one end, relative
  int checked = 0;
  const Equilibrium strip{std::string(kStrip)};
  ASSERT_GT(std::abs(strip.value("tip.displacement.z")), 0.08);
  const struct {
    const char *path, *format;
    double value, si;
  } parameters[] = {{"regions.body.axes.angle", "{} deg", 20, std::numbers::pi / 180},
                    {"materials.wood.young.0", "{} GPa", 10.8, 1e9},
                    {"materials.wood.nu12", "{}", 0.37, 1},
                    {"terms.0.pressure", "{}", 20000, 1},
                    {"mesh.size.2", "{}", 0.004, 1}};
  for (const auto& p : parameters) {
    const auto at = [&](double value) {
      Config scene = Config::from_text(kStrip, "scene.yaml");
      scene.set_yaml(p.path, fmt::format(fmt::runtime(p.format), value));
      return Equilibrium(scene);
    };
    const double steps[] = {0.02 * p.value, 0.01 * p.value};
    const Equilibrium before[] = {at(p.value - steps[0]), at(p.value - steps[1])};
    const Equilibrium after[] = {at(p.value + steps[0]), at(p.value + steps[1])};
    for (const char* quantity : {"tip.displacement.z", "tip.displacement.y", "energy.elastic", "tip.nodal_strain.11"}) {
      const double exact = strip.derivative(p.path, quantity);
      const auto error = [&](int i) {
        return (after[i].value(quantity) - before[i].value(quantity)) / (2 * steps[i] * p.si) - exact;
      };
      if (std::abs(error(0)) < kRounding * std::abs(exact)) continue;
      EXPECT_NEAR(std::log2(std::abs(error(0) / error(1))), 2, 0.3) << p.path << " " << quantity;
      ++checked;
    }
  }
  EXPECT_GE(checked, 14);  // of 20
}

// A column under more than its buckling load, in its straight and unstable equilibrium: K is indefinite. The end moves
// by u = -F L / (E A) there, so du/dE = -u / E.
TEST(EquilibriumSensitivity, ExistsOnAnUnstableBranch) {
  const Equilibrium column(std::string(R"(
analysis: static
mesh: {type: box, size: [1, 0.05, 0.05], cells: [8, 1, 1]}
materials: {m: {type: isotropic, density: 1000, young: 1 GPa, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [-2000, 0, 0]}]
statics: {at_limit: follow}
output: {probes: {end: {at: [1, 0, 0]}}}
)"));
  ASSERT_GE(column.problem.stepper->unstable().value_or(0), 1);
  const double u = -2000 / (1e9 * 0.0025);
  ASSERT_NEAR(column.value("end.displacement.x"), u, 1e-6 * std::abs(u));
  EXPECT_NEAR(column.derivative("materials.m.young", "end.displacement.x"), -u / 1e9, 1e-6 * std::abs(u) / 1e9);
}

TEST(EquilibriumSensitivity, IsRefusedForNumbersThatChangeTheMesh) {
  const Equilibrium strip{std::string(kStrip)};
  EXPECT_THROW(strip.derivative("mesh.cells.0", "tip.displacement.z"), ConfigError);
}

}  // namespace
}  // namespace orthodyn::equilibrium_sensitivity_test
