// Static analyses on several ranks, and motions that start from equilibrium.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/simulation/several_ranks.h"

namespace orthodyn::ranks_statics_test {
namespace {

class StaticsOnRanks : public SeveralRanks {
 protected:
  std::vector<double> place_of_top(const std::string& name) const {
    return record(name).at("probes").at("top").at("displacement").get<std::vector<double>>();
  }
};

// A beam with large deflection.
const std::string kBent = R"(
analysis: static
mesh: {type: box, size: [1, 0.1, 0.1], cells: [12, 2, 2], order: 2}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, 20]}]
output:
  fields: [displacement, nodal_stress]
  probes: {tip: {at: [1, 0.05, 0.05]}, middle: {at: [0.5, 0.05, 0.05]}}
)";

TEST_F(StaticsOnRanks, FindTheEquilibriaOfOne) {
  write("bent.yaml", kBent);
  ASSERT_EQ(orthodyn("run bent.yaml --quiet --out one").exit_code, 0);
  const auto expected = record("one");
  for (const int ranks : {2, 3}) {
    const std::string out = "on_" + std::to_string(ranks);
    const auto result = orthodyn_on(ranks, "run bent.yaml --out " + out);
    ASSERT_EQ(result.exit_code, 0) << result.output;
    const auto found = record(out);
    for (const char* key : {"load_steps", "rejected_load_steps"}) EXPECT_EQ(found.at(key), expected.at(key)) << key;
    expect_alike(out, "one", 1e-7, {"probes.csv"});
    const auto error_of = [](const auto& probe) { return probe.at("mesh_error").template get<std::vector<double>>(); };
    // Several ranks use recovered stresses, one process finer elements: similar where both resolve the error.
    for (const char* probe : {"tip", "middle"}) {
      const double on_ranks = error_of(found.at("probes").at(probe))[2],
                   on_one = error_of(expected.at("probes").at(probe))[2];
      EXPECT_GT(on_ranks / on_one, 0.5) << probe;
      EXPECT_LT(on_ranks / on_one, 2) << probe;
    }
  }
}

// By factorisation, and by conjugate gradients, which detect an indefinite K only during the iteration.
TEST_F(StaticsOnRanks, GoPastALimitPoint) {
  const std::string toggle = std::string(ORTHODYN_SOURCE_DIR) + "/configs/scenes/toggle.yaml";
  ASSERT_EQ(orthodyn("run " + toggle + " --quiet --out one").exit_code, 0);
  for (const std::string solver : {"auto", "petsc"}) {
    const auto result =
        orthodyn_on(2, "run " + toggle + " --quiet --out " + solver + " --set statics.solver.linear_solver=" + solver);
    ASSERT_EQ(result.exit_code, 0) << result.output;
    EXPECT_EQ(record(solver).at("load_steps"), record("one").at("load_steps")) << solver;
    expect_alike(solver, "one", 1e-5, {"probes.csv"});
    ASSERT_EQ(record(solver).at("critical_points").size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto found = record(solver).at("critical_points")[k];
      EXPECT_EQ(found.at("kind"), "limit point");
      EXPECT_NEAR(found.at("load_factor"), record("one").at("critical_points")[k].at("load_factor"), 1e-6);
    }
  }
}

// An axially loaded column buckles: every solver detects it on one and several ranks, and leaves the path to the same
// side.
const std::string kColumn = R"(
analysis: static
mesh: {type: box, size: [0.05, 0.06, 1], cells: [1, 1, 8], order: 2}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
clamps: [{surface: z0}]
loads: [{surface: z1, force: [0, 0, -3]}]
statics: {at_limit: jump, first_step: 0.1, max_step: 0.1}
output: {probes: {top: {at: [0.025, 0.03, 1]}}}
)";

TEST_F(StaticsOnRanks, LeaveABifurcationToTheSameSide) {
  write("column.yaml", kColumn);
  const auto alone = orthodyn("run column.yaml --out one");
  ASSERT_EQ(alone.exit_code, 0) << alone.output;
  ASSERT_EQ(record("one").at("critical_points").size(), 1u) << alone.output;
  const double expected = record("one").at("critical_points")[0].at("load_factor");
  EXPECT_NEAR(expected * 3, std::pow(std::numbers::pi / 2, 2) * 1e6 * 0.06 * std::pow(0.05, 3) / 12, 0.05 * 1.5);
  for (const int ranks : {1, 2, 3})
    for (const std::string solver : {"auto", "petsc"}) {
      if (solver == "petsc" && ranks > 2) continue;  // on two cores they would wait for each other
      const std::string out = solver + std::to_string(ranks);
      const std::string command = "run column.yaml --out " + out + " --set statics.solver.linear_solver=" + solver;
      const auto result = ranks == 1 ? orthodyn(command) : orthodyn_on(ranks, command);
      ASSERT_EQ(result.exit_code, 0) << result.output;
      ASSERT_EQ(record(out).at("critical_points").size(), 1u) << result.output;
      EXPECT_NEAR(record(out).at("critical_points")[0].at("load_factor"), expected, 1e-3 * expected);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(place_of_top(out)[c], place_of_top("one")[c], 1e-4) << out;
    }
}

// Two separate tetrahedra: one of three ranks is empty.
TEST_F(StaticsOnRanks, TellOfAPartThatIsNotHeld) {
  write("two.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 3 0 0\n"
        "6 4 0 0\n7 3 1 0\n8 3 0 1\n$EndNodes\n$Elements\n2\n1 4 2 1 1 1 2 3 4\n2 4 2 1 1 5 6 7 8\n"
        "$EndElements\n");
  write("two.yaml", R"(
analysis: static
mesh: {type: gmsh, file: two.msh}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
gravity: [0, 0, -1]
terms: [{type: spring, between: [[1, 0, 0], [3, 0, 0]], stiffness: 300}]
)");
  const auto alone = orthodyn("run two.yaml --out one");
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.output.find("the part of the body about"), std::string::npos) << alone.output;
  const auto result = orthodyn_on(3, "run two.yaml --out several");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("the part of the body about"), std::string::npos) << result.output;
}

TEST_F(StaticsOnRanks, TellOfABodyThatIsNotHeld) {
  std::string scene = kBent;
  scene.replace(scene.find("clamps: [{surface: x0}]"), 23, "clamps: [{surface: x0, components: [x, y]}]");
  write("free.yaml", scene);
  const auto alone = orthodyn("run free.yaml --out one");
  EXPECT_NE(alone.output.find("can be translated along z"), std::string::npos) << alone.output;
  for (const int ranks : {2, 3}) {
    const auto result = orthodyn_on(ranks, "run free.yaml --out several");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.output.find("can be translated along z"), std::string::npos) << result.output;
  }
}

TEST_F(StaticsOnRanks, AreWhereAMotionStarts) {
  write("beam.yaml", kBeam + std::string("gravity: [0, 0, -1]\nstart: equilibrium\ntime: {end: 0.1}\n"
                                         "integrator: {type: generalized_alpha, step: 0.01, rtol: 1e-9}\n"));
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out one").exit_code, 0);
  const auto result = orthodyn_on(3, "run beam.yaml --quiet --out three");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  expect_alike("three", "one", 1e-6);
}

}  // namespace
}  // namespace orthodyn::ranks_statics_test
