// Modal runs: cost, automatic kinematics, and resumption.
#include <algorithm>

#include "lib/simulation/output/json.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::modal_run_test {
namespace {

const std::string kBar = R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [10, 2, 2]}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -1]}]
time: {end: 0.1}
)";

class ModalRun : public InFolder {
 protected:
  Json record(const std::string& folder) const { return Json::parse(read_text(folder_ / folder / "run.json")); }
};

void expect_said(const CommandResult& result, const std::string& part) {
  EXPECT_NE(result.output.find(part), std::string::npos) << part << "\nin: " << result.output;
}

// A single short step: nearly all the time is spent on the modes.
TEST_F(ModalRun, CountsTheTimeOfItsModes) {
  write("scene.yaml", kBar +
                          "elasticity: {kinematics: linear}\nintegrator: {type: modal, modes: 40}\n"
                          "output: {frames: 0, mesh_error: false}\n");
  const auto result = orthodyn("run scene.yaml --out out --set time.end=1e-6");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  expect_said(result, "modes                1 x");
  const Json all = record("out"), statistics = all.at("statistics");
  EXPECT_EQ(statistics.at("modes").at("count"), 1);
  EXPECT_EQ(statistics.at("factorization").at("count"), 0);
  EXPECT_GT(all.at("wall_seconds").get<double>(), statistics.at("modes").at("seconds").get<double>());
}

const std::string kOpen =
    "elasticity: {kinematics: auto, linear_error: 0.01}\nintegrator: {type: modal, modes: 20}\n"
    "output: {probes: {tip: {at: [1, 0.05, 0.05]}}}\n";

TEST_F(ModalRun, TakesLinearKinematicsWhereTheyServe) {
  write("scene.yaml", kBar + kOpen);
  const auto result = orthodyn("run scene.yaml --out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  expect_said(result, "kinematics      linear: off by about");
}

// At twice its static deflection, 0.8 of its length by beam theory.
TEST_F(ModalRun, IsRefusedWhereLinearKinematicsWouldNotServe) {
  write("scene.yaml", kBar + kOpen);
  const auto result = orthodyn("run scene.yaml --out out --set 'loads.0.force=[0, 0, -1e4]'");
  EXPECT_EQ(result.exit_code, 2) << result.output;
  expect_said(result, "elasticity.kinematics: linear kinematics would be off by");
  expect_said(result,
              "modal is for linear kinematics only: use another integrator, such as cvode_bdf, or raise "
              "elasticity.linear_error");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  const auto follows =
      orthodyn("run scene.yaml --out out --set 'terms=[{type: pressure, surface: x1, pressure: 1, follows: true}]'");
  EXPECT_EQ(follows.exit_code, 2) << follows.output;
  expect_said(follows, "modal integrates only linear models");
}

// An initial state that the static response does not include.
TEST_F(ModalRun, EndsWhereLinearKinematicsAreOutgrownAndKeepsItsOutput) {
  write("scene.yaml", kBar + kOpen + "initial: {velocity_field: [0, 0, \"x^2\"]}\n");
  const auto result = orthodyn("run scene.yaml --out out --set elasticity.linear_error=1e-3");
  EXPECT_EQ(result.exit_code, 3) << result.output;
  expect_said(result, "linear kinematics are off by");
  expect_said(result,
              "where 0.001 is allowed; modal is for linear kinematics only: use another integrator, such as cvode_bdf, "
              "or raise elasticity.linear_error");
  EXPECT_EQ(result.output.find("starts again"), std::string::npos) << result.output;
  EXPECT_EQ(record("out").at("status"), "failed");
  const std::string probes = read_text(folder_ / "out/probes.csv");
  EXPECT_GT(std::count(probes.begin(), probes.end(), '\n'), 2);
  const auto raised = orthodyn("run scene.yaml --out raised --set elasticity.linear_error=1");
  EXPECT_EQ(raised.exit_code, 0) << raised.output;
}

}  // namespace
}  // namespace orthodyn::modal_run_test
