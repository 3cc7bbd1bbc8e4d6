// Bodies under tension, which adds stiffness across them without damping: default scales and orders, and vibrations.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/analysis/scales.h"
#include "tests/problems/running.h"

namespace orthodyn::tension_test {
namespace {

constexpr double kLength = 0.4, kStretch = 0.004, kYoung = 4e9, kDensity = 1600, kSpeed = 0.2;  // SI

// A strip of 0.1 mm that starts in equilibrium, stretched by `stretch`, with the velocity of its first mode. Its ends
// slide up and down without turning.
std::string strip(double stretch, const std::string& method, double damping = 1e-5) {
  return fmt::format(R"(
mesh: {{type: box, size: [{0}, 0.01, 1e-4], cells: [16, 1, 1], elements: hexahedra}}
materials: {{film: {{type: isotropic, density: {1}, young: {2}, nu: 0}}}}
initial:
  displacement_field: ["{3}*x", 0, 0]
  velocity_field: [0, 0, '{4}*cos(pi*x/{0})']
clamps: [{{surface: x0, components: [x]}}, {{surface: y0, components: [y]}}, {{surface: y1, components: [y]}}]
motions: [{{surface: x1, components: [x], displacement: [{5}, 0, 0]}}]
damping: {{stiffness: {7}}}
time: {{end: 0.04}}
integrator: {{type: {6}, rtol: 1e-4}}
)",
                     kLength, kDensity, kYoung, stretch, kSpeed, stretch * kLength, method, damping);
}

// The angular frequency of a string.
double frequency() { return std::numbers::pi / kLength * std::sqrt(kYoung * kStretch / kDensity / (1 + kStretch)); }

Scales scales_of(const BuiltTestScene& s) {
  const double end = s.scene.time.end;
  return estimate_scales(s.model(), s.built.initial, end, static_response(s.model(), s.built.initial, end));
}

// The energy of the tension is a hundred times the kinetic energy, and does not move the strip.
TEST(Tension, HasNoPartInTheScaleOfVelocities) {
  const BuiltTestScene s(strip(kStretch, "ida_bdf"));
  EXPECT_NEAR(scales_of(s).velocity, 3 * kSpeed / std::sqrt(2), 0.02 * kSpeed);
}

// A strip that is let go has the velocities of its elastic energy, (E e^2/2)/rho per mass.
TEST(Tension, OfAStripThatIsLetGoMovesIt) {
  std::string yaml = strip(kStretch, "ida_bdf");
  const auto motions = yaml.find("motions:");
  yaml.erase(motions, yaml.find('\n', motions) - motions);
  const BuiltTestScene s(yaml);
  const double of_tension = std::sqrt(kYoung * kStretch * kStretch / kDensity);
  EXPECT_NEAR(scales_of(s).velocity, 3 * of_tension, 0.05 * 3 * of_tension);
}

std::string order_of(const BuiltTestScene& s) {
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  for (const auto& [key, value] : integrator->decisions())
    if (key == "max_order") return value;
  return "none";
}

// Without tension, bending is damped: the damping ratio is 1e-2 at the frequency of the motion. With tension, the
// transverse vibration is hardly damped.
TEST(Tension, IsNotDampedByTheDampingOfTheMaterial) {
  for (const char* method : {"cvode_bdf", "ida_bdf"}) {
    EXPECT_EQ(order_of(BuiltTestScene(strip(kStretch, method, 0.01))), "2") << method;
    EXPECT_EQ(order_of(BuiltTestScene(strip(0, method, 0.01))), "5") << method;
  }
  EXPECT_EQ(order_of(BuiltTestScene(strip(kStretch, "auto", 0.01))), "none");  // not a multistep method
}

// After five periods, the strip has the velocities of the start. Its damping, with the ratio beta omega_b^2/(2 omega)
// of the frequency omega_b of bending alone, 0.4 % of omega, takes nothing.
TEST(Tension, MakesAStringOfTheStrip) {
  for (const char* method : {"cvode_bdf", "auto"}) {
    std::string yaml = strip(kStretch, method);
    yaml.replace(yaml.find("1e-4}"), 5, "1e-6}");
    const double period = 2 * std::numbers::pi / frequency();
    yaml.replace(yaml.find("end: 0.04"), 9, fmt::format("end: {}", 5 * period));
    const BuiltTestScene s(yaml);
    const double start = s.model().evaluate("energy.kinetic", s.built.initial)[0];
    double end = 0;
    const Outcome outcome =
        run_scene(s, 1, [&](const State& state) { end = s.model().evaluate("energy.kinetic", state)[0]; });
    ASSERT_EQ(outcome.status, Outcome::Status::completed) << method << outcome.message;
    EXPECT_NEAR(end, start, 0.02 * start) << method;
  }
}

}  // namespace
}  // namespace orthodyn::tension_test
