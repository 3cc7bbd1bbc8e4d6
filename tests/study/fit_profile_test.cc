// Intervals by profile likelihood: closed forms for a bar under tension.
#include <cmath>

#include "lib/simulation/output/json.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::fit_profile_test {
namespace {

// u = F L / (E A) = 2.5 um for 100 N.
const char* const kBar = R"(
analysis: static
mesh: {type: box, size: [0.5, 0.1, 0.2], cells: [2, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1 GPa, nu: 0}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [100, 0, 0]}]
output: {probes: {end: {at: [0.5, 0, 0]}}}
)";

constexpr double kNormal = 1.959964;

class FitProfile : public InFolder {
 protected:
  FitProfile() { write("bar.yaml", kBar); }
  CommandResult fit(const std::string& text) const {
    write("f.yaml", text + "intervals: profile\nrefine: false\n");
    return orthodyn("fit f.yaml --no-report");
  }
  Json end(std::size_t parameter, const char* name) const {
    return Json::parse(read_text(folder_ / "out/fits/f/fit.json"))
        .at("parameters")
        .at(parameter)
        .at("profile")
        .at(name);
  }
  double value(std::size_t parameter, const char* name) const { return end(parameter, name).at("value").get<double>(); }
};

// The displacement is linear in the force, which the search changes by factors: its profile is symmetric all the same.
TEST_F(FitProfile, OfALinearParameterIsItsNormalInterval) {
  const auto result = fit(R"(
experiments: {bar: {scene: bar.yaml, measured: [{quantity: end.displacement.x, value: 2.5 um, deviation: 0.25 um}]}}
parameters: {F: {path: loads.0.force.0, start: 90}}
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const double half = kNormal * 10, accuracy = 0.01 * half;
  EXPECT_NEAR(value(0, "low"), 100 - half, accuracy);
  EXPECT_NEAR(value(0, "high"), 100 + half, accuracy);
  EXPECT_NE(result.output.find("profile 80.4"), std::string::npos) << result.output;
}

// Two loads with an unknown zero: the difference of both readings, 2.5 um / E, has the deviation sqrt(2) 0.1 um.
TEST_F(FitProfile, IsMinimisedOverTheOtherParameters) {
  write("more.yaml", std::string(kBar).replace(std::string(kBar).find("[100, 0"), 4, "[200"));
  const auto result = fit(R"(
experiments:
  low: {scene: bar.yaml, measured: [{quantity: end.displacement.x, value: 2.5 um, deviation: 0.1 um,
        offset: {name: zero}}]}
  high: {scene: more.yaml, measured: [{quantity: end.displacement.x, value: 5 um, deviation: 0.1 um,
         offset: {name: zero}}]}
parameters: {E: {path: materials.m.young, start: 1.1 GPa}}
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const double half = kNormal * std::sqrt(2) * 0.1;
  EXPECT_NEAR(value(0, "low"), 2.5 / (2.5 + half), 2e-3);
  EXPECT_NEAR(value(0, "high"), 2.5 / (2.5 - half), 2e-3);
  // offset = 2 y_low - y_high, linear
  EXPECT_NEAR(value(1, "high"), kNormal * std::sqrt(5) * 1e-7, 0.01 * kNormal * std::sqrt(5) * 1e-7);
  EXPECT_NEAR(value(1, "low"), -kNormal * std::sqrt(5) * 1e-7, 0.01 * kNormal * std::sqrt(5) * 1e-7);
}

TEST_F(FitProfile, IsOpenAtABound) {
  const auto result = fit(R"(
experiments: {bar: {scene: bar.yaml, measured: [{quantity: end.displacement.x, value: 2.5 um, deviation: 0.25 um}]}}
parameters: {E: {path: materials.m.young, start: 0.9 GPa, upper: 1.1 GPa}}
)");
  EXPECT_NEAR(value(0, "low"), 1 / (1 + 0.1 * kNormal), 2e-3) << result.output;
  EXPECT_NEAR(value(0, "high"), 1.1, 1e-9);
  EXPECT_TRUE(end(0, "high").at("open").get<bool>());
  EXPECT_FALSE(end(0, "low").at("open").get<bool>());
  EXPECT_NE(result.output.find("to 1.1 (bound)"), std::string::npos) << result.output;
}

TEST_F(FitProfile, OfWhatTheDataDoNotDetermineIsUnknown) {
  const auto result = fit(R"(
experiments:
  bar:
    scene: bar.yaml
    measured:
      - {quantity: end.displacement.x, value: 2.5 um, deviation: 0.1 um, gain: {name: g}}
      - {quantity: end.displacement.x, value: 2.5 um, deviation: 0.1 um, gain: {name: g}}
parameters: {E: {path: materials.m.young, start: 1.1 GPa}}
)");
  EXPECT_TRUE(end(0, "low").at("value").is_null()) << result.output;
  EXPECT_EQ(end(0, "low").at("failure").get<std::string>(), "the data do not determine it");
  EXPECT_NE(result.output.find("profile unknown to unknown"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace orthodyn::fit_profile_test
