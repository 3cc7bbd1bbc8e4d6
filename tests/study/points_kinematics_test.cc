// Points of studies whose scenes have `kinematics: auto`.
#include <cmath>

#include "tests/study/sweep_command.h"

namespace orthodyn::points_kinematics_test {
namespace {

const std::string kBar = R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1]}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
output: {probes: {tip: {at: [1, 0.05, 0.05]}}}
)";

const std::string kMotion = "integrator: {type: cvode_bdf}\ntime: {end: 0.02}\n";

class PointKinematics : public SweepCommand {
 protected:
  // Metric and kinematics of the single point.
  std::pair<double, std::string> point(const std::string& rest, const std::string& kinematics) const {
    write("scene.yaml", kBar + rest + "elasticity: {kinematics: " + kinematics + "}\n");
    write("s.yaml",
          "scene: scene.yaml\nvary: {materials.m.young: [1e9]}\n"
          "quantities: {sag: {quantity: tip.displacement.z}}\n");
    const auto done = sweep("--out " + kinematics.substr(0, 4));
    EXPECT_EQ(done.exit_code, 0) << done.output;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / kinematics.substr(0, 4)))
      if (entry.path().filename() == "result.json") {
        const Json json = Json::parse(read_text(entry.path()));
        EXPECT_EQ(json.at("status"), "completed") << json.dump();
        return {json.at("metrics").at("sag").get<double>(), json.value("kinematics", "")};
      }
    return {std::nan(""), ""};
  }

  void expect_a_second_start(const std::string& scene) const {
    const auto [open, told] = point(scene, "auto, linear_error: 0.002");
    const auto [exact, nothing] = point(scene, "corotational");
    const auto [linear, neither] = point(scene, "linear");
    EXPECT_EQ(open, exact);
    EXPECT_NE(open, linear);
    EXPECT_TRUE(told.starts_with("corotational: linear kinematics are off by")) << told;
    EXPECT_EQ(nothing, "");
  }
};

// The linear static response does not include an initial velocity.
TEST_F(PointKinematics, ThatAreOutgrownInAMotionMeanASecondStart) {
  expect_a_second_start("initial: {velocity_field: [0, 0, \"3*x^2\"]}\n" + kMotion);
}

// A deflection of 0.8 % of the length is between one and three times the allowed one; above three, linear is not tried.
TEST_F(PointKinematics, ThatAreOutgrownInAnEquilibriumMeanASecondStart) {
  expect_a_second_start("loads: [{surface: x1, force: [0, 0, -200]}]\nanalysis: static\n");
}

TEST_F(PointKinematics, ThatServeAreToldToo) {
  const auto [open, told] = point("loads: [{surface: x1, force: [0, 0, -1]}]\n" + kMotion, "auto");
  EXPECT_TRUE(told.starts_with("linear: off by about")) << told;
}

}  // namespace
}  // namespace orthodyn::points_kinematics_test
