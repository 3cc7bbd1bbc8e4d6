// Scales of bodies whose motion is known.
#include "lib/analysis/scales.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/scene/scenes.h"

namespace orthodyn::scales_test {
namespace {

Scales scales_of(const std::string& yaml) {
  const Scene scene = read_scene(Config::from_text(yaml));
  const BuiltScene built = build(scene);
  return estimate_scales(*built.model, built.initial, scene.time.end,
                         static_response(*built.model, built.initial, scene.time.end));
}

TEST(Scales, FollowTheStaticDeflectionOfAStiffBodyAndTheSizeOfASoftOne) {
  // A bar pulled along itself: u = F L / (E A) at nu = 0, W = F u.
  const std::string bar = R"(mesh: {type: box, size: [2, 1, 1], cells: [2, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [1000, 0, 0], factor: {type: ramp, end: 0.05}}]
time: {end: 0.1}
)";
  const double u = 1000 * 2 / 1e6, work = 1000 * u;
  EXPECT_NEAR(scales_of(bar).position, 2 * u, 1e-10);
  EXPECT_NEAR(scales_of(bar).velocity, 3 * std::sqrt(2 * work / 2000), 1e-10);
  EXPECT_NEAR(scales_of(replaced(bar, "1e6", "1e2")).position, 0.1 * 2, 1e-12);
}

TEST(Scales, DoNotHangOnRoundOffInTheRestShapeOrOnWhereALoadIsSampled) {
  const std::string bar = R"(mesh: {type: box, size: [0.7, 0.3, 0.1], cells: [3, 3, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [3, 0, 0], factor: {type: sine, frequency: 50}}]
time: {end: 1}
)";
  EXPECT_NEAR(scales_of(bar).position, 2 * 3 * 0.7 / (1e6 * 0.03), 1e-7);
}

TEST(Scales, OfASpinningFreeBodyComeFromItsKineticEnergy) {
  const auto yaml = replaced(kValidScene, "clamps:\n  - surface: x0\n", "initial: {velocity: [3, 0, 0]}\n");
  EXPECT_NEAR(scales_of(yaml).velocity, 3 * 3.0, 1e-12);
}

// Approximately a spring k = E A/L with the mass m of the four end nodes (of unequal mass): v0 starts an amplitude of
// v0 sqrt(m/k).
TEST(Scales, OfAHeldBodyThatIsStruckComeFromTheVibration) {
  const std::string bar = R"(mesh: {type: box, size: [2, 1, 1], cells: [1, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0}}
clamps: [{surface: x0}, {box: {min: [0, 0, 0], max: [2, 1, 1]}, components: [y, z]}]
initial: {velocity: [3e-3, 0, 0]}
time: {end: 0.1}
)";
  const double m = 2000 / 2, k = 1e9 / 2;
  const double expected = 3 * 3e-3 * std::sqrt(m / k) * std::sqrt(m / 2000);
  EXPECT_NEAR(scales_of(bar).position, expected, 0.02 * expected);
}

// The same spring: an impulse J starts v0 = J/m, independent of the static response to its peak.
TEST(Scales, OfAHeldBodyUnderAShortLoadComeFromItsImpulse) {
  const std::string bar = R"(mesh: {type: box, size: [2, 1, 1], cells: [1, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0}}
clamps: [{surface: x0}, {box: {min: [0, 0, 0], max: [2, 1, 1]}, components: [y, z]}]
loads: [{surface: x1, force: [1000, 0, 0], factor: {type: expression, formula: exp(-((t-0.03)/1e-4)^2)}}]
time: {end: 0.1}
)";
  const double m = 2000 / 2, k = 1e9 / 2, impulse = 1000 * 1e-4 * std::sqrt(std::numbers::pi);
  const double v0 = impulse / m, expected = 3 * v0 * std::sqrt(m / k) * std::sqrt(m / 2000);
  EXPECT_NEAR(scales_of(bar).position, expected, 0.03 * expected);
  const auto longer = replaced(bar, "1e-4", "1e-2");  // than a period of 9 ms
  EXPECT_NEAR(scales_of(bar).omega, scales_of(longer).omega, 1e-6 * scales_of(longer).omega);
  EXPECT_NEAR(scales_of(bar).velocity, 1.5 * scales_of(bar).omega * scales_of(bar).position, 1e-9 * v0);
  EXPECT_NEAR(scales_of(longer).position, 2 * 1000 / k, 1e-3 * 1000 / k);
}

// Evenly spaced samples would all hit zeros of the base motion.
TEST(Scales, SeeAMotionOfWholePeriods) {
  const auto yaml =
      kValidScene + "motions: [{surface: x1, translation: [1e-9, 0, 0], factor: {type: sine, frequency: 2000}}]\n";
  EXPECT_NEAR(scales_of(yaml).position, 2e-9, 1e-11);
}

TEST(Scales, ShrinkWithTheStiffnessOfWhatTheBodyMayTouch) {
  const auto block = [](const char* stiffness) {
    return scales_of(fmt::format(R"(mesh: {{type: box, size: [1, 1, 1], cells: [2, 2, 2], origin: [0, 0, 1], order: 1}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e6, nu: 0}}}}
terms: [{{type: ground_contact, stiffness: {}}}]
gravity: [0, 0, -10]
time: {{end: 0.1}}
)",
                                 stiffness));
  };
  // W = m g L; the node in the middle of a face has eight triangles of 1/8 m^2, a third of each is its own.
  const double work = 1000 * 10, area = 1.0 / 3;
  EXPECT_NEAR(block("1e9").position, std::sqrt(2 * work / (1e9 * area)), 1e-9);
  EXPECT_NEAR(block("1e3").position, 0.1, 1e-12);
}

TEST(Scales, OfABodyThatIsOnlyMovedComeFromItsSupports) {
  const auto yaml =
      kValidScene + "motions: [{surface: x1, translation: [3e-3, 4e-3, 0], factor: {type: smooth_step, end: 0.1}}]\n";
  const Scales scales = scales_of(yaml);
  EXPECT_NEAR(scales.position, 2 * 5e-3, 1e-12);
  EXPECT_NEAR(scales.velocity, 3 * 5e-3 / 0.1 * 15 / 8, 1e-4);  // the step's largest rate, in its middle
}

}  // namespace
}  // namespace orthodyn::scales_test
