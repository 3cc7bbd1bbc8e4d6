// Runs of bodies that swell: sensitivities, statics in steps, motions with a balance of energy, mistakes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lib/simulation/sensitivity/gradient.h"
#include "lib/simulation/simulation.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::expansion_test {
namespace {

// A strip with oblique grain that dries unevenly, held at one end.
std::string strip(double coefficient, double change, double factor) {
  return fmt::format(R"(
analysis: static
mesh: {{type: box, size: [0.3, 0.03, 0.008], cells: [6, 1, 1], elements: hexahedra}}
materials:
  wood: {{type: orthotropic, density: 450, young: [0.5 GPa, 0.04 GPa, 0.04 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 0.035 GPa, g23: 0.01 GPa, g13: 0.035 GPa, expansion: {{moisture: [5e-5, {:.17g}, 3e-3]}}}}
regions: {{body: {{material: wood, axes: {{type: axis_angle, axis: [0, 0, 1], angle: 20 deg}},
                 stiffness_factors: {{grid: [3, 1, 1], values: [1.2, {:.17g}, 1]}}}}}}
moisture: {{change: '{:.17g}*(1 + 100*z)'}}
loads: [{{surface: x1, force: [0, 0, 0.2]}}]
clamps: [{{surface: x0}}]
output:
  probes:
    tip: {{at: [0.3, 0.03, 0.008]}}
)",
                     coefficient, factor, change);
}

class Expansion : public InFolder {
 protected:
  double tip(const std::string& scene) const {
    write("scene.yaml", scene);
    const CommandResult result = orthodyn("run scene.yaml --quiet --force --out out");
    EXPECT_EQ(result.exit_code, 0) << result.output;
    const std::string table = read_text(folder_ / "out/probes.csv");
    const std::string last = table.substr(table.rfind('\n', table.size() - 2) + 1);
    return std::stod(last.substr(last.rfind(',') + 1));  // tip.displacement.z
  }
};

TEST_F(Expansion, DerivativesByCoefficientsAndFactorsAreThoseOfRepeatedRuns) {
  const double a = 1.5e-3, change = -4, factor = 0.8;
  const Gradient found = gradient(
      Config::from_text(strip(a, change, factor), "scene.yaml").resolving(),
      {"tip.displacement.z", {}, {"materials.wood.expansion.moisture.1", "regions.body.stiffness_factors.values.1"}});
  ASSERT_EQ(found.derivatives.size(), 2u);
  const auto expect_order_two = [](double expected, double step, const auto& of) {
    const auto error = [&](double h) { return std::abs((of(h) - of(-h)) / (2 * h) - expected); };
    const double coarse = error(step), fine = error(step / 2);
    EXPECT_LE(fine, 1e-3 * std::abs(expected));
    if (fine > 1e-6 * std::abs(expected)) {
      EXPECT_NEAR(coarse / fine, 4, 0.8);
    }
  };
  expect_order_two(found.derivatives[0], 0.05 * a, [&](double h) { return tip(strip(a + h, change, factor)); });
  expect_order_two(found.derivatives[1], 0.04, [&](double h) { return tip(strip(a, change, factor + h)); });
}

// A strip that is pulled out of its plane by a moisture that comes and goes.
TEST_F(Expansion, EnergyIsBalanced) {
  write("scene.yaml", R"(
mesh: {type: box, size: [0.3, 0.03, 0.008], cells: [6, 1, 1], elements: hexahedra}
materials:
  wood: {type: orthotropic_stable, density: 450, young: [0.5 GPa, 0.04 GPa, 0.04 GPa], nu: 0.3,
         expansion: {moisture: [5e-5, 1.5e-3, 3e-3]}}
regions: {body: {material: wood, axes: {first: [0, 1, 0], second: [1, 0, 0]}}}
moisture: {formula: '1000*z*sin(20*t)'}
clamps: [{surface: x0}]
damping: {mass: 5, stiffness: 1e-3}
time: {end: 0.05}
integrator: {type: cvode_bdf, rtol: 1e-6}
expect:
  - {quantity: energy.balance, take: drift, value: 0, absolute: 1e-3, source: the work of the swelling is stored or dissipated, reason: 1000 rtol}
)");
  const CommandResult result = orthodyn("verify scene.yaml");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, testing::HasSubstr("1 of 1 cases pass"));
}

// The strip curls by 1.5 rad; automatic kinematics must not be linear then, and must be for a small change.
TEST_F(Expansion, AutomaticKinematicsSeeTheSwelling) {
  const auto kinematics = [&](double change) {
    write("scene.yaml", fmt::format(R"(
analysis: static
mesh: {{type: box, size: [0.15, 0.012, 0.003], cells: [15, 1, 1], elements: hexahedra}}
materials:
  birch: {{type: preset, name: yellow_birch}}
  spruce: {{type: preset, name: sitka_spruce}}
regions:
  all: {{axes: {{first: [1, 0, 0], second: [0, 1, 0]}}, layup: [[birch, 90 deg, 2 mm], [spruce, 0, 1 mm]]}}
elasticity: {{kinematics: auto}}
moisture: {{change: {}}}
clamps: [{{surface: x0}}]
)",
                                    change));
    const CommandResult result = orthodyn("run scene.yaml --force --out out");
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return result.output;
  };
  EXPECT_THAT(kinematics(8), testing::HasSubstr("corotational"));
  EXPECT_THAT(kinematics(1e-3), testing::HasSubstr("linear"));
}

// A column between two walls buckles when it is heated: e L^2 A/I = 4 pi^2 for a column that is clamped at both ends.
TEST_F(Expansion, BucklingFindsTheCriticalTemperature) {
  write("scene.yaml", R"(
analysis: buckling
mesh: {type: box, size: [0.5, 0.012, 0.005], cells: [25, 1, 1], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1 GPa, nu: 0, expansion: {temperature: 1e-5}}}
temperature: {change: 1}
clamps: [{surface: x0}, {surface: x1}]
buckling: {count: 1}
expect:
  - {buckling: 1, value: 32.899, relative: 1e-2, source: '4 pi^2 h^2/(12 L^2)/1e-5', reason: 'a slender column: shear lowers the load by 0.1 %'}
)");
  const CommandResult result = orthodyn("verify scene.yaml");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, testing::HasSubstr("1 of 1 cases pass"));
}

}  // namespace
}  // namespace orthodyn::expansion_test
