// The estimated mesh error of stresses at probes in a static run, against Lame's solution of a thick tube.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::probed_stress_test {
namespace {

// Radii 1 and 2 m, fixed along its axis, under internal pressure p.
std::string tube(double nu, int cells) {
  return fmt::format(R"(
analysis: static
mesh: {{type: tube, inner_radius: 1, radius: 2, length: 0.2, cells: [{}, {}, 1]}}
materials: {{m: {{type: isotropic, density: 1, young: 1, nu: {}}}}}
elasticity: {{kinematics: linear}}
clamps:
  - {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}, components: [x]}}
  - {{plane: {{point: [0, 0, 0], normal: [0, 1, 0]}}, components: [y]}}
  - {{surface: end0, components: [z]}}
  - {{surface: end1, components: [z]}}
terms: [{{type: pressure, surface: inner, pressure: 1e-3}}]
output: {{probes: {{inside: {{at: [1, 0, 0.1], fields: [nodal_stress]}}, middle: {{at: [1.5, 0, 0.1], fields: [nodal_stress]}}}}}}
)",
                     4 * cells, cells, nu);
}

using Stress = Eigen::Matrix<double, 6, 1>;  // xx, yy, zz, xy, yz, zx

// On the x axis. Source: Timoshenko & Goodier, Theory of Elasticity, 3rd ed., section 28.
Stress lame(double nu, double r) {
  const double across = 1e-3 / 3 * (1 - 4 / (r * r)), around = 1e-3 / 3 * (1 + 4 / (r * r));
  return (Stress() << across, around, nu * (across + around), 0, 0, 0).finished();
}

struct Case {
  double nu;
  int cells;
};

class ProbedStress : public InFolder, public testing::WithParamInterface<Case> {};
INSTANTIATE_TEST_SUITE_P(Tubes, ProbedStress, testing::Values(Case{0.3, 4}, Case{0.49, 4}, Case{0.3, 6}));

TEST_P(ProbedStress, HasAnErrorThatIsToldToAFactorOfTwo) {
  const auto [nu, cells] = GetParam();
  write("tube.yaml", tube(nu, cells));
  ASSERT_EQ(orthodyn("run tube.yaml --quiet --out result").exit_code, 0);
  const auto told = nlohmann::json::parse(read_text(folder_ / "result/run.json")).at("errors").at("probes");
  const auto row = read_rows(folder_ / "result/probes.csv").back();
  ASSERT_EQ(row.size(), 13u);
  for (const auto& [name, r, first] : {std::tuple{"inside", 1.0, 1}, std::tuple{"middle", 1.5, 7}}) {
    const double error = (Stress(row.data() + first) - lame(nu, r)).norm();
    const auto& found = told.at(name).at("nodal_stress");
    EXPECT_EQ(found.at("unit"), "Pa");
    EXPECT_GT(found.at("error").get<double>(), 0.7 * error) << name;
    EXPECT_LT(found.at("error").get<double>(), 2 * error) << name;
  }
}

class CoarseStress : public InFolder {};

// A finer mesh would have eight times the unknowns, more than the allowed 120,000.
TEST_F(CoarseStress, OfALargeModelIsSaidToHaveNoKnownError) {
  write("tube.yaml", [] {
    std::string scene = tube(0.3, 4);
    return scene.replace(scene.find("[16, 4, 1]"), 10, "[48, 8, 2]");
  }());
  const auto large = orthodyn("run tube.yaml --out result");
  ASSERT_EQ(large.exit_code, 0) << large.output;
  EXPECT_NE(large.output.find("of stresses and strains at probes unknown"), std::string::npos) << large.output;
  EXPECT_TRUE(nlohmann::json::parse(read_text(folder_ / "result/run.json")).at("errors").at("probes").is_null());
}

TEST_F(CoarseStress, IsWarnedOf) {
  write("tube.yaml", tube(0.3, 4));
  const auto coarse = orthodyn("run tube.yaml --out result");
  EXPECT_NE(
      coarse.output.find("warning: the mesh is coarse for 1 of 2 probed stresses or strains: nodal_stress of inside"),
      std::string::npos)
      << coarse.output;
  EXPECT_NE(coarse.output.find("nodal_stress of middle"), std::string::npos) << coarse.output;
}

}  // namespace
}  // namespace orthodyn::probed_stress_test
