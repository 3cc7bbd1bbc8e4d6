// Reported values of a whole run do not depend on the number of frames, or a warning says so.
#include <gtest/gtest.h>

#include "lib/simulation/output/extremes.h"
#include "lib/simulation/output/json.h"
#include "lib/simulation/output/strain_watch.h"
#include "lib/simulation/run/setup.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::few_frames_test {
namespace {

// A strip across the grain of spruce swings far beyond the validity of the law, and returns.
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
  EXPECT_NE(few.output.find("warning: extremes are those of 2 states"), std::string::npos) << few.output;
  EXPECT_NE(few.output.find("output.history: {steps: true}"), std::string::npos) << few.output;
  EXPECT_EQ(extreme("few").at("states"), 2);
  const auto all = run_strip("all", " --set 'output.history={steps: true}'");
  EXPECT_EQ(all.output.find("output.history: {steps: true}"), std::string::npos) << all.output;
  EXPECT_GT(extreme("all").at("value").get<double>(), 2 * extreme("few").at("value").get<double>());
}

TEST_F(FewFrames, AStrengthThatIsExceededIsAWarning) {
  const auto result = run_strip("strong", " --set 'output.extremes=[max_stress.largest]'");
  const std::string sentence = "the strength is exceeded from 1 on, at (";
  EXPECT_NE(result.output.find("warning: max_stress reaches "), std::string::npos) << result.output;
  EXPECT_NE(result.output.find(sentence), std::string::npos) << result.output;
  EXPECT_NE(read_text(folder_ / "strong/run.json").find(sentence), std::string::npos);
}

TEST_F(FewFrames, AHistoryThatIsDenserThanTheStepsIsCountedByItsStates) {
  const auto result =
      run_strip("dense", " --set 'output.history={interval: 1e-5}' --set output.extremes=[] --integrator cvode_bdf");
  EXPECT_NE(result.output.find("outputs, events  20001 states x"), std::string::npos) << result.output;
}

TEST_F(FewFrames, ALookAtTheStrainsKeepsItsCadenceWhereARunIsResumed) {
  const orthodyn::Setup setup = set_up(Config::from_file((folder_ / "strip.yaml").string()));
  const auto watch = [&] { return StrainWatch::of_motion(*setup.built.model, 200); };  // a look a second
  StrainWatch before = watch(), after = watch();
  const Vector rest = setup.built.initial.q;
  const auto last_look_after = [&](StrainWatch& observer, double t) {
    const State state{t, rest, rest};
    observer.on_step({}, {*setup.built.model, state}, *setup.integrator);
    Archive archive;
    observer.save(archive);
    return archive.number("last_look");
  };
  EXPECT_EQ(last_look_after(before, 0.5), 0.5);
  Archive archive;
  before.save(archive);
  after.restore(archive);
  EXPECT_EQ(last_look_after(after, 1.25), 0.5);
  EXPECT_EQ(last_look_after(after, 1.5), 1.5);
}

RecordedExtreme extreme_of(const std::string& quantity, double value) {
  return {quantity, "", value, 0.3, 7, {0.1, 0.2, 0}, 5};
}

TEST(ExceededStrengths, AreThoseOfExposuresAboveOne) {
  EXPECT_EQ(exceeded_strengths({extreme_of("max_stress.largest", 3.7)}, false),
            std::vector<std::string>{
                "max_stress reaches 3.7: the strength is exceeded from 1 on, at (0.1, 0.2, 0) m, at t = 0.3 s"});
  EXPECT_EQ(exceeded_strengths({extreme_of("grip.tsai_wu.largest", 2)}, true),
            std::vector<std::string>{
                "grip.tsai_wu reaches 2: the strength is exceeded from 1 on, at (0.1, 0.2, 0) m, at load factor 0.3"});
  EXPECT_TRUE(exceeded_strengths({extreme_of("hashin.largest", 1), extreme_of("von_mises.largest", 4e6),
                                  extreme_of("max_stress.smallest", 2)},
                                 false)
                  .empty());
}

}  // namespace
}  // namespace orthodyn::few_frames_test
