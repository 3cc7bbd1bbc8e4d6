// Stiffness factors of a region: closed forms, homogeneity, and their input.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "lib/scene/build.h"
#include "lib/simulation/sensitivity/frequency_sensitivity.h"
#include "lib/simulation/sensitivity/gradient.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::stiffness_factors_test {
namespace {

// A bar of two halves in series under tension, without contraction across.
std::string bar(double first, double second) {
  return fmt::format(R"(
analysis: static
mesh: {{type: box, size: [2, 0.1, 0.2], cells: [4, 1, 1], order: 1}}
materials: {{m: {{type: isotropic, density: 1000, young: 1 GPa, nu: 0}}}}
regions: {{body: {{material: m, stiffness_factors: {{grid: [2, 1, 1], values: [{}, {}]}}}}}}
elasticity: {{kinematics: linear}}
clamps: [{{surface: x0, components: [x]}}, {{nearest: [0, 0, 0]}}, {{nearest: [0, 0.1, 0], components: [z]}}]
loads: [{{surface: x1, force: [100, 0, 0]}}]
output: {{probes: {{end: {{at: [2, 0, 0]}}}}}}
)",
                     first, second);
}

Gradient gradient_of(const std::string& scene, const std::string& quantity, const std::vector<std::string>& paths) {
  return gradient(Config::from_text(scene, "scene.yaml").resolving(), {quantity, {}, paths});
}

const char* const kFactors = "regions.body.stiffness_factors";

// u = F L/2 / (E A) (1/s1 + 1/s2).
TEST(StiffnessFactors, OfABarInSeriesHaveTheClosedForm) {
  const double half = 100.0 * 1 / (1e9 * 0.02), s1 = 0.4, s2 = 1.7;
  const Gradient found = gradient_of(bar(s1, s2), "end.displacement.x", {kFactors});
  EXPECT_NEAR(found.value, half * (1 / s1 + 1 / s2), 1e-12 * found.value);
  ASSERT_EQ(found.derivatives.size(), 2u);
  EXPECT_NEAR(found.derivatives[0], -half / (s1 * s1), 1e-9 * half);
  EXPECT_NEAR(found.derivatives[1], -half / (s2 * s2), 1e-9 * half);
}

// The stiffness is homogeneous of degree 1 in all factors, and so is a modulus in its own right: the displacement of a
// linear scene is of degree -1, a frequency of degree 1/2.
const char* const kPlate = R"(
mesh: {type: box, size: [0.3, 0.2, 0.01], cells: [4, 3, 1], elements: hexahedra}
materials:
  wood: {type: orthotropic, density: 450, young: [11 GPa, 0.9 GPa, 0.5 GPa], nu12: 0.37, nu13: 0.47, nu23: 0.44,
         g12: 0.75 GPa, g23: 0.03 GPa, g13: 0.7 GPa}
regions: {body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 20 deg},
                 stiffness_factors: {grid: [3, 2, 1], values: [1, 0.5, 2, 1.3, 0.8, 1.1]}}}
clamps: [{surface: x0}]
time: {end: 1}
)";

TEST(StiffnessFactors, FrequenciesAreOfDegreeOneHalf) {
  const Config config = Config::from_text(kPlate, "scene.yaml").resolving();
  const Scene scene = read_scene(config);
  const BuiltScene built = build(scene);
  const Vector zero = Vector::Zero(built.model->num_dofs());
  const State rest{0, zero, zero, 0};
  const Modes modes = natural_modes(*built.model, rest, 4);
  std::vector<std::string> paths;
  for (int k = 0; k < 6; ++k) paths.push_back(fmt::format("{}.values.{}", kFactors, k));
  const auto slopes = frequency_sensitivities(config, *built.model, rest, modes, scene_parameters(config, paths));
  for (std::size_t mode = 0; mode < 4; ++mode) {
    double sum = 0;
    for (const auto& slope : slopes) {
      EXPECT_GT(slope.derivatives[mode], 0);
      sum += slope.parameter.value() * slope.derivatives[mode];
    }
    const double frequency = modes.modes[mode].frequency();
    EXPECT_NEAR(sum, frequency / 2, 1e-6 * frequency) << "mode " << mode + 1;
  }
}

TEST(StiffnessFactors, OfOneChangeNothing) {
  const std::string plain = "regions: {body: {material: m}}";
  std::string with = bar(1, 1), without = with;
  const auto begin = without.find("regions:");
  without.replace(begin, without.find('\n', begin) - begin, plain);
  for (const auto& kinematics : {"linear", "corotational"}) {
    const auto value = [&](std::string scene) {
      scene.replace(scene.find("linear"), 6, kinematics);
      return gradient_of(scene, "end.displacement.x", {"materials.m.young"});
    };
    EXPECT_NEAR(value(with).value, value(without).value, 1e-13 * value(without).value);
    EXPECT_NEAR(value(with).derivatives[0], value(without).derivatives[0], 1e-9 * -value(without).derivatives[0]);
  }
}

class StiffnessFactorInput : public InFolder {
 protected:
  std::string refusal(const std::string& factors) const {
    std::string scene = bar(1, 1);
    const auto begin = scene.find("{grid"), end = scene.find("}", begin) + 1;
    scene.replace(begin, end - begin, factors);
    write("scene.yaml", scene);
    const CommandResult result = orthodyn("check scene.yaml");
    EXPECT_NE(result.exit_code, 0) << factors;
    return result.output;
  }
};

TEST_F(StiffnessFactorInput, IsRefusedWithTheReason) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal("{grid: [2, 1, 1], values: [1]}"), HasSubstr("has 1 factors, and the grid has 2 cells"));
  EXPECT_THAT(refusal("{grid: [2, 1, 1], values: [1, -1]}"), HasSubstr("values.1"));
  EXPECT_THAT(refusal("{values: [1, 1]}"), HasSubstr("grid"));
  write("f.csv", "i,j,k,factor\n1,1,1,0.5\n");
  EXPECT_THAT(refusal("{grid: [2, 1, 1], file: f.csv}"), HasSubstr("no factor for the cell 2, 1, 1"));
  write("f.csv", "i,j,k,factor\n1,1,1,0.5\n1,1,1,0.5\n");
  EXPECT_THAT(refusal("{grid: [2, 1, 1], file: f.csv}"), HasSubstr("f.csv:3: has a second factor"));
  write("f.csv", "i,j,k,factor\n1,1,1,0.5\n3,1,1,0.5\n");
  EXPECT_THAT(refusal("{grid: [2, 1, 1], file: f.csv}"), HasSubstr("i is 3; the grid has 1 to 2"));
  EXPECT_THAT(refusal("{grid: [2, 1, 1], values: [1, 1], file: f.csv}"), HasSubstr("beside 'file'"));
}

TEST_F(StiffnessFactorInput, CannotBeSetOneByOneWithoutTheList) {
  std::string scene = bar(1, 1);
  const auto begin = scene.find("{grid"), end = scene.find("}", begin) + 1;
  scene.replace(begin, end - begin, "{grid: [2, 1, 1]}");
  write("scene.yaml", scene);
  const CommandResult result = orthodyn("check scene.yaml --set regions.body.stiffness_factors.values.1=0.5");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.output, testing::HasSubstr("stiffness_factors.values: entry 1 cannot be changed, because the list "
                                                "itself is not given: write the whole list"));
}

TEST_F(StiffnessFactorInput, FromAFileAreThoseOfTheList) {
  write("f.csv", "i,j,k,factor,x [m]\n2,1,1,1.7,1.5\n1,1,1,0.4,0.5\n");
  std::string scene = bar(1, 1);
  const auto begin = scene.find("{grid"), end = scene.find("}", begin) + 1;
  scene.replace(begin, end - begin, "{grid: [2, 1, 1], file: " + (folder_ / "f.csv").string() + "}");
  const Gradient found = gradient_of(scene, "end.displacement.x", {"materials.m.young"});
  EXPECT_NEAR(found.value, 5e-6 * (1 / 0.4 + 1 / 1.7), 1e-12 * found.value);
}

}  // namespace
}  // namespace orthodyn::stiffness_factors_test
