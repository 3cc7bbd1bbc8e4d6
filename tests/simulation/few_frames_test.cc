// What is told of a whole run does not depend on how many frames it writes, or says so.
#include <gtest/gtest.h>

#include "lib/simulation/json.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::few_frames_test {
namespace {

// A strip across the grain of spruce swings far beyond what the law holds for, and comes back.
class FewFrames : public InFolder {
 protected:
  FewFrames() {
    write("strip.yaml", R"(
mesh: {type: box, size: [0.4, 0.04, 0.012], cells: [8, 1, 1]}
materials: {spruce: {type: preset, name: sitka_spruce}}
regions: {body: {material: spruce, axes: {type: axis_angle, axis: [0, 0, 1], angle: 90 deg}}}
clamps: [{surface: x0}]
initial: {velocity_field: ["0", "0", "-300*(x/0.4)^2"]}
damping: {stiffness: 1e-3, mass: 5}
time: {end: 0.2}
output: {frames: 1, extremes: [von_mises.largest]}
)");
  }
  CommandResult run_strip(const std::string& name, const std::string& options) {
    return orthodyn("run strip.yaml --out " + name + options);
  }
  Json extreme(const std::string& name) const {
    return Json::parse(read_text(folder_ / name / "run.json")).at("extremes").at("von_mises.largest");
  }
};

TEST_F(FewFrames, DoNotHideAStrainLimitThatWasPassed) {
  for (const char* frames : {"1", "100"}) {
    const auto result = run_strip(frames, std::string(" --set output.frames=") + frames);
    EXPECT_NE(result.output.find("warning: region body: "), std::string::npos) << frames << result.output;
  }
}

TEST_F(FewFrames, AreToldBesideExtremesAndStepsFindMore) {
  const auto few = run_strip("few", "");
  EXPECT_NE(few.output.find("of 2 states; output.history: {steps: true} looks at every step"), std::string::npos)
      << few.output;
  EXPECT_EQ(extreme("few").at("states"), 2);
  const auto all = run_strip("all", " --set 'output.history={steps: true}'");
  EXPECT_EQ(all.output.find("looks at every step"), std::string::npos) << all.output;
  EXPECT_GT(extreme("all").at("value").get<double>(), 2 * extreme("few").at("value").get<double>());
}

}  // namespace
}  // namespace orthodyn::few_frames_test
