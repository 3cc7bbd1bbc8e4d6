// Runs by modes: what they cost, kinematics that are left open, and how they go on.
#include "lib/simulation/json.h"
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

// A single short step: nearly all that the run takes is for its modes.
TEST_F(ModalRun, CountsTheTimeOfItsModes) {
  write("scene.yaml", kBar + "elasticity: {kinematics: linear}\nintegrator: {type: modal, modes: 40}\n"
                             "output: {frames: 0, mesh_error: false}\n");
  const auto result = orthodyn("run scene.yaml --out out --set time.end=1e-6");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  expect_said(result, "modes                1 x");
  const Json all = record("out"), statistics = all.at("statistics");
  EXPECT_EQ(statistics.at("modes").at("count"), 1);
  EXPECT_EQ(statistics.at("factorization").at("count"), 0);
  EXPECT_GT(all.at("wall_seconds").get<double>(), statistics.at("modes").at("seconds").get<double>());
}

}  // namespace
}  // namespace orthodyn::modal_run_test
