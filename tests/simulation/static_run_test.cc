// `orthodyn run` of static scenes, and events of dynamic ones.
#include <cmath>
#include <numbers>

#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::static_run_test {
namespace {

const char* const kShelf = R"(analysis: static
mesh: {type: box, size: [1, 0.2, 0.1], cells: [4, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, traction: [1e5, 0, 0]}]
output: {probes: {end: {at: [1, 0.1, 0.05]}}}
)";

class StaticRun : public InFolder {};

TEST_F(StaticRun, WritesAFrameAndARowPerLoadStep) {
  write("shelf.yaml", kShelf);
  const auto result = orthodyn("run shelf.yaml --out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  for (const char* part : {"load factor 0.25", "completed at load factor 1", "load steps", "largest displacement"})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << "\nin: " << result.output;
  const auto rows = read_rows(folder_ / "out/probes.csv");
  ASSERT_EQ(rows.size(), 4u);  // load factors 0, 0.25, 0.75, 1
  for (const auto& row : rows) EXPECT_NEAR(row[1], 0.1 * row[0], 1e-7);
  EXPECT_EQ(read_rows(folder_ / "out/load_steps.csv").size(), 4u);
  EXPECT_NE(read_text(folder_ / "out/frames.pvd").find("timestep=\"0.75\""), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out/frames/frame_00003.vtu"));
  const auto record = read_text(folder_ / "out/run.json");
  for (const char* part : {"\"status\": \"completed\"", "\"load_factor_reached\": 1.0", "\"load_steps\": 3"})
    EXPECT_NE(record.find(part), std::string::npos) << part << "\nin: " << record;
}

TEST_F(StaticRun, ByAnIterativeSolverEndsWhereThatByAFactorDoes) {
  write("shelf.yaml", kShelf);
  std::vector<std::vector<double>> last;
  for (const std::string solver : {"cholesky", "petsc"}) {
    const auto result =
        orthodyn("run shelf.yaml --quiet --force --out out --set statics.solver.linear_solver=" + solver);
    if (result.output.find("built without PETSc") != std::string::npos) GTEST_SKIP() << result.output;
    ASSERT_EQ(result.exit_code, 0) << result.output;
    last.push_back(read_rows(folder_ / "out/probes.csv").back());
  }
  for (std::size_t i = 0; i < last[0].size(); ++i) EXPECT_NEAR(last[0][i], last[1][i], 1e-8);
}

TEST_F(StaticRun, OfItsResolvedSceneIsTheSame) {
  write("shelf.yaml", kShelf);
  ASSERT_EQ(orthodyn("run shelf.yaml --out out --quiet").exit_code, 0);
  const auto again = orthodyn("run out/scene.yaml --out again --quiet");
  ASSERT_EQ(again.exit_code, 0) << again.output;
  EXPECT_EQ(read_text(folder_ / "out/probes.csv"), read_text(folder_ / "again/probes.csv"));
}

TEST_F(StaticRun, ThatCannotGoOnKeepsItsStepsAndSaysWhere) {
  write("shelf.yaml", kShelf);
  const auto result = orthodyn("run shelf.yaml --out out --set statics.max_steps=2");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.output.find("load factor"), std::string::npos) << result.output;
  EXPECT_EQ(read_rows(folder_ / "out/load_steps.csv").size(), 3u);  // load factors 0, 0.25, 0.75
  EXPECT_NE(read_text(folder_ / "out/run.json").find("\"status\": \"failed\""), std::string::npos);
}

TEST_F(StaticRun, WithAMovedSupportHasTheExtremesOfItsEquilibria) {
  write("shelf.yaml", std::string(kShelf) + R"(
motions: [{surface: x1, translation: [1e-3, 0, 0], factor: {type: ramp, end: 1}}]
time: {end: 1}
)");
  const auto result = orthodyn(
      "run shelf.yaml --out out --set loads=[] --set 'output.extremes=[nodal_stress.xx.largest, "
      "nodal_stress.xx.smallest]'");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  for (const char* which : {"largest", "smallest"})  // E times the strain
    EXPECT_NE(result.output.find(std::string("nodal_stress.xx.") + which + (which[0] == 'l' ? ": 1000 Pa" : ": 0 Pa")),
              std::string::npos)
        << result.output;
}

// Supports move with the load factor, in equilibrium all along; rotating supports turn about their axis. By symmetry
// the middle of a twisted bar turns by half the angle; its contraction is of second order in the twist.
TEST_F(StaticRun, MovesSupportsWithTheLoadFactor) {
  write("bar.yaml", R"(
analysis: static
mesh: {type: box, size: [2, 0.1, 0.1], cells: [40, 2, 2], order: 1}
materials: {m: {type: isotropic, density: 1, young: 1e6, nu: 0}}
clamps: [{surface: x0, components: [x]}, {nearest: [0, 0, 0]}, {nearest: [0, 0.1, 0], components: [z]}]
motions: [{surface: x1, components: [x], translation: [0.02, 0, 0], factor: {type: ramp, end: 3}}]
statics: {max_step: 0.25}
time: {end: 3}
output: {probes: {middle: {at: [1, 0, 0], fields: [displacement, nodal_stress]}}, extremes: [nodal_stress.xx.largest]}
)");
  const auto pulled = orthodyn("run bar.yaml --out pulled");
  ASSERT_EQ(pulled.exit_code, 0) << pulled.output;
  const auto rows = read_rows(folder_ / "pulled/probes.csv");
  EXPECT_GE(rows.size(), 5u);
  for (const auto& row : rows) {
    EXPECT_NEAR(row[1], 0.01 * row[0], 1e-10) << row[0];
    EXPECT_NEAR(row[4], 1e4 * row[0], 1e-3) << row[0];  // E times the strain
  }
  const auto turned = orthodyn(
      "run bar.yaml --out turned --set 'clamps=[{surface: x0}]' --set 'motions.0={surface: x1, rotation: {axis: [1, 0, "
      "0], point: [0, 0.05, 0.05], angle: 150 deg}, factor: {type: constant}}' --set output.probes.middle.at='[1, 0, "
      "0.05]'");
  ASSERT_EQ(turned.exit_code, 0) << turned.output;
  for (const auto& row : read_rows(folder_ / "turned/probes.csv")) {
    const double angle = row[0] * 75 * std::numbers::pi / 180, y = row[2] - 0.05, z = row[3];  // from the axis
    const double shear = 0.05 * angle;  // of the outer fibres: the distance to the axis times the angle per length
    EXPECT_NEAR(row[1], 0, 1e-12) << row[0];
    EXPECT_NEAR(std::atan2(-z, -y), angle, 1e-9) << row[0];
    EXPECT_NEAR(std::hypot(y, z), 0.05, 0.05 * shear * shear) << row[0];
  }
}

// Displacements negligible beside the body's size.
TEST_F(StaticRun, OfALinearModelMeetsItsToleranceInOneCorrectionAStep) {
  write("shelf.yaml", kShelf);
  const auto result =
      orthodyn("run shelf.yaml --out out --set elasticity.kinematics=linear --set 'loads.0.traction=[1e-9, 0, 0]'");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  for (const auto& row : read_rows(folder_ / "out/load_steps.csv"))
    if (row[0] > 0) {
      EXPECT_LE(row[2], 1e-8 * 2e-11 / 4) << row[0];  // N: a corner's share of the load
    }
}

// Only the summary reports the residual: the displacements are accurate, and there is no warning.
TEST_F(StaticRun, TellsTheResidualThatRoundOffLeavesWithoutAWarning) {
  write("shelf.yaml", kShelf);
  const auto result = orthodyn(
      "run shelf.yaml --out out --set statics.solver.rtol=1e-15 --set output.mesh_error=false --set 'mesh.cells=[20, "
      "4, 4]' --set 'loads.0.traction=[0, 0, 1]'");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output.find("warning: the residual"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("of the largest load component"), std::string::npos) << result.output;
}

// The strip does not buckle: R K R^T is not a derivative of the warped force.
TEST_F(StaticRun, WithAnApproximateStiffnessDoesNotSpeakOfBuckling) {
  const std::string strip = R"(analysis: static
mesh: {type: box, size: [1, 0.04, 0.01], cells: [40, 2, 2], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0}}
elasticity: {corotation: warped}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, 80]}]
statics: {min_step: 0.02}
output: {fields: []}
)";
  write("strip.yaml", strip);
  const auto rotated = orthodyn("run strip.yaml --out rotated --quiet --set statics.solver.max_iterations=6");
  EXPECT_EQ(rotated.exit_code, 3);
  for (const char* word : {"limit point", "bifurcation"})
    EXPECT_EQ(rotated.output.find(word), std::string::npos) << rotated.output;
  EXPECT_NE(rotated.output.find("warped_tangent: unsymmetric"), std::string::npos) << rotated.output;
  const auto exact = orthodyn(
      "run strip.yaml --out exact --quiet --set elasticity.warped_tangent=unsymmetric --set "
      "statics.solver.linear_solver=klu");
  EXPECT_EQ(exact.exit_code, 0) << exact.output;
}

// For any statics.at_limit: there is neither a limit point nor a bifurcation.
TEST_F(StaticRun, OfABodyThatIsNotQuiteStraightSaysThatItsStablePathWasFollowed) {
  write("column.yaml", R"(analysis: static
mesh: {type: box, size: [1, 0.05, 0.01], cells: [20, 2, 1]}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [-15, 0, 0.015]}]  # Euler's load is 10.3 N
output: {fields: []}
)");
  for (const char* choice : {"stop", "jump"}) {
    const auto result = orthodyn(std::string("run column.yaml --force --out out --set statics.at_limit=") + choice);
    ASSERT_EQ(result.exit_code, 0) << result.output;
    for (const char* part :
         {"sharp turn", "stay stable", "statics.at_limit acts at limit points and bifurcations only"})
      EXPECT_NE(result.output.find(part), std::string::npos) << part << "\nin: " << result.output;
  }
}

TEST_F(StaticRun, RefusesAFreeBodyBeforeItWritesAnything) {
  write("shelf.yaml", kShelf);
  const auto result = orthodyn("run shelf.yaml --out out --set clamps=[]");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("its equilibrium is not unique"), std::string::npos) << result.output;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(StaticRun, RefusesWhatOnlyAMotionCanDo) {
  write("shelf.yaml", kShelf);
  for (const char* option : {"--resume", "--estimate-error"}) {
    const auto result = orthodyn(std::string("run shelf.yaml --out out ") + option);
    EXPECT_EQ(result.exit_code, 2) << option;
    EXPECT_NE(result.output.find("a static analysis"), std::string::npos) << result.output;
  }
}

TEST_F(StaticRun, IsCheckedAndBegunLikeADynamicOne) {
  write("shelf.yaml", kShelf);
  const auto check = orthodyn("check shelf.yaml");
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_NE(check.output.find("all rigid motions are held"), std::string::npos) << check.output;
  ASSERT_EQ(orthodyn("init static mine.yaml").exit_code, 0);
  EXPECT_EQ(orthodyn("check mine.yaml").exit_code, 0);
}

class EventRun : public InFolder {};

std::string swing_with(const std::string& events) { return std::string(kSwing) + "events:\n" + events; }

TEST_F(EventRun, LogsEachCrossingAndStopsWhereItIsTold) {
  write("swing.yaml", swing_with("- {quantity: tip.displacement.z, crosses: -0.01, name: low}\n"
                                 "- {quantity: tip.displacement.z, crosses: -0.05, direction: down, action: stop}\n"));
  const auto result = orthodyn("run swing.yaml --out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("stopped by the event 'tip.displacement.z' at t = "), std::string::npos)
      << result.output;
  std::istringstream table(read_text(folder_ / "out/events.csv"));
  std::string header, low, stop, none;
  std::getline(table, header);
  std::getline(table, low);
  std::getline(table, stop);
  EXPECT_EQ(header, "t [s],event,value,direction");
  EXPECT_NE(low.find(",low,-0.01,down"), std::string::npos) << low;
  EXPECT_NE(stop.find(",tip.displacement.z,-0.05,down"), std::string::npos) << stop;
  EXPECT_FALSE(std::getline(table, none));
  const auto rows = read_rows(folder_ / "out/probes.csv");
  EXPECT_NEAR(rows.back()[0], std::stod(stop), 1e-12);
  EXPECT_NEAR(rows.back()[3], -0.05, 1e-10);
  EXPECT_NE(read_text(folder_ / "out/run.json").find("\"remark\": \"stopped by the event"), std::string::npos);
}

TEST_F(EventRun, IsTheSameAcrossARestart) {
  write("swing.yaml", swing_with("- {quantity: tip.displacement.z, crosses: -0.01}\n"
                                 "- {quantity: energy.kinetic, crosses: 0.05}\n") +
                          "checkpoint: {every: 1000}\n");
  ASSERT_EQ(orthodyn("run swing.yaml --out whole --quiet").exit_code, 0);
  ASSERT_EQ(orthodyn("run swing.yaml --out parts --quiet --set integrator.max_steps=12").exit_code, 3);
  const auto resumed = orthodyn("run swing.yaml --out parts --quiet --resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.output;
  std::istringstream whole(read_text(folder_ / "whole/events.csv")), parts(read_text(folder_ / "parts/events.csv"));
  std::string a, b;
  int rows = 0;
  while (std::getline(whole, a)) {
    ASSERT_TRUE(std::getline(parts, b));
    ++rows;
    if (rows == 1) continue;
    EXPECT_NEAR(std::stod(a), std::stod(b), 2e-3);
    EXPECT_EQ(a.substr(a.find(',')), b.substr(b.find(',')));
  }
  EXPECT_FALSE(std::getline(parts, b));
  EXPECT_GT(rows, 2);
}

TEST_F(EventRun, RefusesVectorsUnknownQuantitiesAndAnErrorEstimateOfAStoppedRun) {
  write("swing.yaml", swing_with("- {quantity: tip.displacement, crosses: 1}\n"));
  auto result = orthodyn("run swing.yaml --out out");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("events.0: 'tip.displacement' has several components"), std::string::npos)
      << result.output;
  write("swing.yaml", swing_with("- {quantity: top.displacement.z, crosses: 1}\n"));
  result = orthodyn("run swing.yaml --out out");
  EXPECT_NE(result.output.find("did you mean 'tip.displacement.z'"), std::string::npos) << result.output;
  write("swing.yaml", swing_with("- {quantity: tip.displacement.z, crosses: -0.01, action: stop}\n"));
  result = orthodyn("run swing.yaml --out out --estimate-error");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("--estimate-error"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace orthodyn::static_run_test
