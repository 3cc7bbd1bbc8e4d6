// Gradients by adjoint equations against forward sensitivities of the same motion, and against differences between
// runs.
#include "lib/simulation/sensitivity/gradient.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "tests/simulation/run_program.h"

namespace orthodyn::gradient_test {
namespace {

// A strip that is pulled for a while, and shakes under its weight.
std::string strip(const std::string& more) {
  return R"(
mesh: {type: box, size: [0.3, 0.03, 0.008], cells: [6, 1, 1], elements: hexahedra}
materials:
  wood: {type: orthotropic, density: 450, young: [0.5 GPa, 0.04 GPa, 0.04 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 0.035 GPa, g23: 0.01 GPa, g13: 0.035 GPa}
regions: {body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 20 deg},
                 stiffness_factors: {grid: [3, 1, 1], values: [1.2, 0.8, 1]}}}
gravity: [0, 0, -9.81]
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0.2, 0], factor: {type: table, points: [[0, 1], [0.05, 1], [0.06, 0]]}}]
time: {end: 0.2}
output:
  frames: 0
  history: {interval: 0.05}
  probes:
    tip: {at: [0.3, 0.03, 0.008], fields: [displacement, velocity]}
)" + more;
}

const std::vector<std::string> kPaths{"regions.body.stiffness_factors.values.0",
                                      "regions.body.stiffness_factors.values.1",
                                      "regions.body.stiffness_factors.values.2",
                                      "materials.wood.young.0",
                                      "materials.wood.density",
                                      "regions.body.axes.angle",
                                      "gravity.2",
                                      "loads.0.force.1"};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream stream(line);
  for (std::string entry; std::getline(stream, entry, ',');) out.push_back(entry);
  return out;
}

std::pair<std::vector<std::string>, std::vector<double>> header_and_last_row(const fs::path& file) {
  std::istringstream stream(read_text(file));
  std::string header, last;
  std::getline(stream, header);
  for (std::string line; std::getline(stream, line);) last = line;
  std::vector<double> values;
  for (const std::string& entry : split(last)) values.push_back(std::stod(entry));
  return {split(header), values};
}

const char* const kTight = "integrator: {type: cvode_bdf, rtol: 1e-8}\n";

class GradientOfAMotion : public InFolder {
 protected:
  // Derivatives at the end of the motion by forward sensitivities, in the order of kPaths.
  std::vector<double> forward(const std::string& scene, const std::string& quantity) const {
    std::string with = scene + "sensitivities: [";
    for (const std::string& path : kPaths) with += path + ", ";
    write("scene.yaml", with + "]\n");
    const CommandResult result = orthodyn("run scene.yaml --quiet --force --out out");
    EXPECT_EQ(result.exit_code, 0) << result.output;
    const auto [names, last] = header_and_last_row(folder_ / "out/sensitivities.csv");
    std::vector<double> out;
    for (const std::string& path : kPaths)
      for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i].starts_with("d " + quantity + " / d " + path + " ")) out.push_back(last[i]);
    EXPECT_EQ(out.size(), kPaths.size());
    return out;
  }

  void expect_equal(const std::string& scene, const std::string& quantity, double tolerance) const {
    const std::vector<double> expected = forward(scene, quantity);
    const Gradient found = gradient(Config::from_text(scene, "scene.yaml").resolving(), {quantity, {}, kPaths});
    ASSERT_EQ(found.derivatives.size(), expected.size());
    double largest = 0;  // change by 1 % or 1 degree
    for (std::size_t i = 0; i < expected.size(); ++i)
      largest = std::max(largest, std::abs(expected[i] * found.parameters[i].usual_change()));
    EXPECT_GT(largest, 0);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(found.derivatives[i] * found.parameters[i].usual_change(),
                  expected[i] * found.parameters[i].usual_change(), tolerance * largest)
          << quantity << " by " << kPaths[i];
  }
};

TEST_F(GradientOfAMotion, IsThatOfForwardSensitivitiesWithDamping) {
  const std::string scene =
      strip(std::string("elasticity: {kinematics: linear}\ndamping: {stiffness: 2 ms}\n") + kTight);
  expect_equal(scene, "tip.displacement.z", 1e-4);
  expect_equal(scene, "tip.velocity.y", 1e-3);
}

TEST_F(GradientOfAMotion, IsThatOfForwardSensitivitiesWithLargeRotations) {
  // Without damping, forward sensitivities of stiff modes need many steps: a short motion.
  std::string scene = strip(
      "elasticity: {kinematics: corotational}\ndamping: {mass: 3}\ninitial: {velocity_field: [0, 0, 40*x]}\n"
      "integrator: {type: cvode_bdf, rtol: 1e-5}\n");
  scene.replace(scene.find("cells: [6, 1, 1]"), 16, "cells: [3, 1, 1]");
  scene.replace(scene.find("end: 0.2"), 8, "end: 0.004");
  scene.replace(scene.find("0.05}"), 5, "0.004}");
  expect_equal(scene, "tip.displacement.z", 5e-3);
}

TEST_F(GradientOfAMotion, IsThatOfForwardSensitivitiesFromEquilibrium) {
  const std::string scene =
      strip(std::string("start: equilibrium\nelasticity: {kinematics: linear}\ndamping: {stiffness: 2 ms}\n") + kTight);
  expect_equal(scene, "tip.displacement.y", 1e-3);
}

// A pulse that is shorter than the steps.
TEST_F(GradientOfAMotion, IsThatOfForwardSensitivitiesWithAShortPulse) {
  std::string scene = strip(std::string("elasticity: {kinematics: linear}\ndamping: {stiffness: 2 ms}\n") + kTight);
  const std::string load = "[[0, 1], [0.05, 1], [0.06, 0]]";
  scene.replace(scene.find(load), load.size(), "[[0, 0], [0.15, 0], [0.1502, 40], [0.1504, 0]]");
  expect_equal(scene, "tip.displacement.y", 1e-3);
}

// The error of the gradient follows rtol.
TEST_F(GradientOfAMotion, ConvergesWithRtol) {
  const auto at = [](const char* rtol) {
    const std::string scene = strip(fmt::format(
        "elasticity: {{kinematics: linear}}\ndamping: {{stiffness: 2 ms}}\nintegrator: {{type: cvode_bdf, rtol: {}}}\n",
        rtol));
    const Gradient found =
        gradient(Config::from_text(scene, "scene.yaml").resolving(), {"tip.displacement.z", {}, kPaths});
    return found.derivatives[0];
  };
  const double exact = at("1e-10");
  const double coarse = std::abs(at("1e-3") - exact), fine = std::abs(at("1e-6") - exact);
  EXPECT_LT(coarse, 0.3 * std::abs(exact));
  EXPECT_LT(fine, 0.05 * coarse);
}

TEST_F(GradientOfAMotion, ReportsItsProgressAndAccuracy) {
  const std::string scene =
      strip(std::string("elasticity: {kinematics: linear}\ndamping: {stiffness: 2 ms}\n") + kTight);
  std::vector<GradientProgress> told;
  GradientRequest request{"tip.displacement.z", 0.1, {"materials.wood.young.0"}};
  request.on_progress = [&](const GradientProgress& progress) { told.push_back(progress); };
  const Gradient found = gradient(Config::from_text(scene, "scene.yaml").resolving(), request);
  using Stage = GradientProgress::Stage;
  ASSERT_GT(told.size(), 10u);
  EXPECT_EQ(told.front().stage, Stage::motion);
  EXPECT_EQ(told.back().stage, Stage::adjoint);
  double last = 0;  // time of the motion
  for (const GradientProgress& one : told) {
    EXPECT_NEAR(one.share, one.stage == Stage::motion ? one.at / 0.1 : 1 - one.at / 0.1, 1e-12);
    if (one.stage == Stage::motion) {
      EXPECT_GT(one.at, std::exchange(last, one.at));
    }
  }
  EXPECT_NEAR(last, 0.1, 1e-12);
  EXPECT_NEAR(told.back().share, 1, 0.05);
  EXPECT_EQ(*found.rtol, 1e-8);
  EXPECT_GE(found.adjoint_rtol, 1e-8);

  write("scene.yaml", scene);
  const CommandResult result = orthodyn("gradient scene.yaml --of tip.displacement.z --by materials.wood.young.0");
  EXPECT_THAT(result.output, testing::HasSubstr("accuracy  rtol 1e-08 for the motion"));
}

// Cells have their numbers along x, y and z from 1; other parameters have none.
TEST_F(GradientOfAMotion, IsATableWithTheCells) {
  std::string scene = strip("elasticity: {kinematics: linear}\nanalysis: static\n");
  for (const char* line : {"time: {end: 0.2}\n", "  history: {interval: 0.05}\n", "  frames: 0\n"})
    scene.erase(scene.find(line), std::string(line).size());
  const std::string factor = ", factor: {type: table, points: [[0, 1], [0.05, 1], [0.06, 0]]}";
  scene.erase(scene.find(factor), factor.size());
  scene.replace(scene.find("grid: [3, 1, 1], values: [1.2, 0.8, 1]"), 38, "grid: [3, 1, 2]");
  scene.replace(scene.find(", velocity]"), 11, "]");
  write("scene.yaml", scene);
  const CommandResult result = orthodyn(
      "gradient scene.yaml --of tip.displacement.z --by regions.body.stiffness_factors --by materials.wood.young.0 "
      "--out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, testing::Not(testing::HasSubstr("accuracy")));
  std::istringstream table(read_text(folder_ / "out/gradient.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_TRUE(line.ends_with(",i,j,k")) << line;
  const char* const cells[] = {",1,1,1", ",2,1,1", ",3,1,1", ",1,1,2", ",2,1,2", ",3,1,2", ",,,"};
  for (const char* cell : cells) {
    ASSERT_TRUE(std::getline(table, line));
    EXPECT_TRUE(line.ends_with(cell)) << line;
  }
}

std::string refusal(const std::string& scene, const GradientRequest& request) {
  try {
    gradient(Config::from_text(scene, "scene.yaml").resolving(), request);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(Gradient, IsRefusedWithTheReason) {
  using testing::HasSubstr;
  const std::string scene = strip(kTight);
  const std::string path = "materials.wood.young.0";
  EXPECT_THAT(refusal(scene, {"tip.nodal_stress.xx", {}, {path}}), HasSubstr("'nodal_stress.xx' is no such quantity"));
  EXPECT_THAT(refusal(scene, {"top.displacement.x", {}, {path}}), HasSubstr("no such probe or gauge; it has tip"));
  EXPECT_THAT(refusal(scene, {"tip.displacement.z", 0.3, {path}}), HasSubstr("outside of the time span"));
  EXPECT_THAT(refusal(scene, {"tip.displacement.z", {}, {}}), HasSubstr("at least one number"));
  EXPECT_THAT(refusal(scene, {"tip.displacement.z", {}, {"time.end"}}), HasSubstr("is no number of the model"));
  EXPECT_THAT(refusal(strip("integrator: {type: ida_bdf}\n"), {"tip.displacement.z", {}, {path}}),
              HasSubstr("set integrator.type to it"));
  EXPECT_THAT(
      refusal(strip(std::string("damping: {stiffness: 1 ms}\nelasticity: {kinematics: corotational}\n") + kTight),
              {"tip.displacement.z", {}, {path}}),
      HasSubstr("stiffness-proportional damping"));
}

}  // namespace
}  // namespace orthodyn::gradient_test
