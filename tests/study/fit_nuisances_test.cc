// `orthodyn fit` with gains, offsets and time offsets of instruments.
#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <vector>

#include "lib/simulation/output/json.h"
#include "lib/study/fit/interpolation.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::fit_nuisances_test {
namespace {

// The polynomials 1, t, ..., t^5 and their slopes are exact, also beside the samples.
TEST(Interpolation, IsExactForPolynomialsOfDegreeFive) {
  const std::vector<double> times{0, 0.1, 0.25, 0.3, 0.5, 0.7, 0.8, 1.1};
  for (const double t : {-0.05, 0.0, 0.13, 0.5, 0.55, 1.1, 1.15})
    for (int degree = 0; degree <= 5; ++degree) {
      const study::fit::Stencil stencil = study::fit::stencil_at(times, t);
      double value = 0, slope = 0;
      for (std::size_t k = 0; k < stencil.weights.size(); ++k) {
        const double sample = std::pow(times[stencil.first + k], degree);
        value += stencil.weights[k] * sample, slope += stencil.slopes[k] * sample;
      }
      EXPECT_NEAR(value, std::pow(t, degree), 1e-12) << t << ' ' << degree;
      EXPECT_NEAR(slope, degree == 0 ? 0 : degree * std::pow(t, degree - 1), 1e-11) << t << ' ' << degree;
    }
}

TEST(Interpolation, HasTheErrorOfSixSamples) {
  const auto error = [](int samples) {
    std::vector<double> times;
    for (int k = 0; k <= 2 * samples; ++k) times.push_back(k * 2 * M_PI / samples);
    double largest = 0;
    for (double t = 5; t < 7; t += 0.01) {
      const study::fit::Stencil stencil = study::fit::stencil_at(times, t);
      double value = 0;
      for (std::size_t k = 0; k < 6; ++k) value += stencil.weights[k] * std::sin(times[stencil.first + k]);
      largest = std::max(largest, std::abs(value - std::sin(t)));
    }
    return largest;
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 6, 0.3);
  EXPECT_LT(error(20), std::pow(M_PI / 20, 6));
}

TEST(Interpolation, OfFewSamplesHasALowerDegree) {
  const study::fit::Stencil stencil = study::fit::stencil_at({1, 3}, 2.5);
  EXPECT_NEAR(stencil.weights[0], 0.25, 1e-15);
  EXPECT_NEAR(stencil.slopes[1], 0.5, 1e-15);
}

// A bar under tension: u = F L / (E A) = 2.5 um for 100 N.
const char* const kBar = R"(
analysis: static
mesh: {type: box, size: [0.5, 0.1, 0.2], cells: [2, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1 GPa, nu: 0}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [100, 0, 0]}]
output: {probes: {end: {at: [0.5, 0, 0]}}}
)";

class FitNuisances : public InFolder {
 protected:
  FitNuisances() { write("bar.yaml", kBar); }
  CommandResult fit(const std::string& text) const {
    write("f.yaml", text);
    return orthodyn("fit f.yaml --no-report");
  }
  Json table() const { return Json::parse(read_text(folder_ / "out/fits/f/fit.json")); }
  Json parameter(std::size_t number) const { return table().at("parameters").at(number); }
  double value(std::size_t number) const { return parameter(number).at("value").get<double>(); }
  double deviation(std::size_t number) const { return parameter(number).at("deviation").get<double>(); }
};

// The second gauge reads 1.2 times the first: ln(gain) = ln(3 / 2.5) has the variances of both readings.
TEST_F(FitNuisances, AGainIsTheRatioOfTwoReadings) {
  const auto result = fit(R"(
experiments:
  bar:
    scene: bar.yaml
    measured:
      - {quantity: end.displacement.x, value: 2.5 um, deviation: 0.01 um}
      - {quantity: end.displacement.x, value: 3 um, deviation: 0.03 um, gain: {start: 1.05}}
parameters: {E: {path: materials.m.young, start: 1.1 GPa}}
refine: false
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(parameter(1).at("name").get<std::string>(), "bar.2.gain");
  EXPECT_NEAR(value(0), 1, 1e-6);
  EXPECT_NEAR(value(1), 1.2, 1e-6);
  EXPECT_NEAR(deviation(1), 1.2 * std::hypot(0.01 / 2.5, 0.03 / 3), 1e-6);
  EXPECT_NE(read_text(folder_ / "out/fits/f/parameters.csv").find("\nbar.2.gain,,"), std::string::npos);
}

// E is known from the first reading to 1e-6, so that the gain is the mean of 3 / 2.5 = 1.2 +- 0.012 and 1 +- 0.02.
TEST_F(FitNuisances, APriorOfAGainCountsAsAMeasuredValue) {
  const auto result = fit(R"(
experiments:
  bar:
    scene: bar.yaml
    measured:
      - {quantity: end.displacement.x, value: 2.5 um, relative: 1e-6}
      - {quantity: end.displacement.x, value: 3 um, deviation: 0.03 um, gain: {deviation: 0.02, name: gauge}}
parameters: {E: {path: materials.m.young, start: 1.1 GPa}}
refine: false
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(parameter(1).at("name").get<std::string>(), "gauge");
  const double reading = 1 / std::pow(0.012, 2), prior = 1 / std::pow(0.02, 2);
  EXPECT_NEAR(value(1), (1.2 * reading + prior) / (reading + prior), 1e-5);
}

// Two loads with one zero: y = u + 0.3 um.
TEST_F(FitNuisances, AnOffsetIsSharedByName) {
  write("more.yaml", std::string(kBar).replace(std::string(kBar).find("[100, 0"), 4, "[200"));
  const auto result = fit(R"(
experiments:
  low: {scene: bar.yaml, measured: [{quantity: end.displacement.x, value: 2.8 um, deviation: 0.01 um,
        offset: {start: 0.1 um, name: zero}}]}
  high: {scene: more.yaml, measured: [{quantity: end.displacement.x, value: 5.3 um, deviation: 0.01 um,
         offset: {start: 0.1 um, name: zero}}]}
parameters: {E: {path: materials.m.young, start: 1.1 GPa}}
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  ASSERT_EQ(table().at("parameters").size(), 2u);
  EXPECT_NEAR(value(0), 1, 1e-6);
  EXPECT_NEAR(value(1), 3e-7, 1e-13);
  EXPECT_EQ(parameter(1).at("unit").get<std::string>(), "m");
  EXPECT_NEAR(deviation(1), std::sqrt(5) * 1e-8, 1e-13);  // offset = 2 y_low - y_high
}

// A table whose times are 37 us late and whose gauge reads 0.8 of the displacement. The first and the last values are
// left out, because the shifted ones are outside of the scene's time.
TEST_F(FitNuisances, ATimeOffsetIsFoundWithoutFurtherRuns) {
  const std::string scene = std::string(kBar).replace(std::string(kBar).find("analysis: static\n"), 17, "") + R"(
damping: {stiffness: 20 us}
time: {end: 0.002}
integrator: {type: cvode_bdf, rtol: 1e-7}
)";
  write("bar.yaml", scene);
  ASSERT_EQ(orthodyn("run bar.yaml --quiet --out truth --set output.frames=100").exit_code, 0);
  std::istringstream rows(read_text(folder_ / "truth" / "probes.csv"));
  std::string line, text = "t [us],reading [um]\n";
  std::getline(rows, line);
  std::vector<std::string> names;
  std::istringstream head(line);
  for (std::string name; std::getline(head, name, ',');) names.push_back(name);
  const auto column = std::ranges::find(names, "end.displacement.x [m]") - names.begin();
  for (int row = 0; std::getline(rows, line); ++row) {
    if (row < 10 || row > 90 || row % 2 == 1) continue;
    std::vector<double> numbers;
    std::istringstream entries(line);
    for (std::string entry; std::getline(entries, entry, ',');) numbers.push_back(std::stod(entry));
    text += fmt::format("{:.12g},{:.12g}\n", 1e6 * numbers[0] - 37, 0.8e6 * numbers[static_cast<std::size_t>(column)]);
  }
  write("data.csv", text);
  const auto result = fit(R"(
experiments:
  bar:
    scene: bar.yaml
    measured:
      - {quantity: end.displacement.x, table: data.csv, column: "reading [um]", deviation: 0.01 um,
         time_offset: {deviation: 30 us}, gain: {deviation: 0.3}}
parameters:
  E: {path: materials.m.young, start: 1.1 GPa}
  damping: {path: damping.stiffness, start: 15 us}
refine: false
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  // The priors draw by their share of the information, far less than the standard deviations.
  for (const auto& [index, truth] : {std::pair{0, 1.0}, {1, 20.0}, {2, 0.8}, {3, 0.037}}) {
    const auto number = static_cast<std::size_t>(index);
    EXPECT_NEAR(value(number), truth, 0.1 * deviation(number) + 1e-4 * truth) << parameter(number).dump();
  }
  EXPECT_EQ(parameter(3).at("name").get<std::string>(), "bar.1.time_offset");
  EXPECT_EQ(parameter(3).at("unit").get<std::string>(), "ms");
  EXPECT_LT(table().at("runs").get<int>(), 20);
}

TEST_F(FitNuisances, RefuseMistakesBeforeAnythingRuns) {
  write("table.csv", "t [s],x [um]\n0,1\n0.1,2\n");
  const std::string moving = std::string(kBar).replace(std::string(kBar).find("analysis: static\n"), 17, "") +
                             "time: {end: 0.1}\nintegrator: {type: cvode_bdf}\n";
  write("moving.yaml", moving);
  const std::string still = "{quantity: end.displacement.x, value: 2.5 um, deviation: 1 um, ";
  const std::string over = "{quantity: end.displacement.x, table: table.csv, column: \"x [um]\", deviation: 1 um, ";
  struct Wrong {
    std::string scene, measured, message;
  };
  const Wrong wrong[] = {
      {"bar", still + "gain: {start: 0}}", "must not be 0"},
      {"bar", still + "gain: {deviation: -0.1}}", "the deviation must be positive"},
      {"bar", still + "gain: {start: 1 mm}}", "mm"},
      {"bar", still + "gain: {begin: 1}}", "begin"},
      {"bar", still + "offset: {start: 1 kg}}", "kg"},
      {"bar", still + "gain: {name: E}}", "already the name of a parameter"},
      {"bar", still + "gain: {name: a}}, " + still + "offset: {name: a}}", "already the name of a nuisance"},
      {"bar", still + "gain: {name: a}}, " + still + "gain: {name: a, deviation: 1}}",
       "already the name of a nuisance"},
      {"bar", still + "time_offset: {deviation: 1 ms}}", "is not used without 'table'"},
      {"moving", over + "time_offset: {deviation: 1 ms}}", "leaves no room"},
      {"moving", over + "time_offset: {start: 20 ms, deviation: 1 ms}}", "leaves no room"},
      {"moving", over + "time_offset: {deviation: 0 ms}}", "the deviation must be positive"}};
  for (const Wrong& one : wrong) {
    const auto result = fit("experiments: {bar: {scene: " + one.scene + ".yaml, measured: [" + one.measured +
                            "]}}\nparameters: {E: materials.m.young}\n");
    EXPECT_EQ(result.exit_code, 2) << one.measured;
    EXPECT_NE(result.output.find(one.message), std::string::npos) << one.message << "\nin: " << result.output;
    EXPECT_FALSE(fs::exists(folder_ / "out/fits/f/points")) << one.measured;
  }
  const auto candidate =
      fit("experiments: {bar: {scene: bar.yaml, measured: [" + still + "}]}}\ncandidates: {c: " +
          "{scene: bar.yaml, measured: [{quantity: end.displacement.x, deviation: 1 um, gain: {}}]}}\n" +
          "parameters: {E: materials.m.young}\n");
  EXPECT_NE(candidate.output.find("a candidate has no gain"), std::string::npos) << candidate.output;
}

// Without a prior the gain and the modulus cannot be told apart.
TEST_F(FitNuisances, AFreeGainOfTheOnlyReadingDeterminesNothing) {
  const auto result = fit(R"(
experiments:
  bar:
    scene: bar.yaml
    measured:
      - {quantity: end.displacement.x, value: 2.5 um, deviation: 0.01 um, gain: {name: g}}
      - {quantity: end.displacement.x, value: 2.5 um, deviation: 0.01 um, gain: {name: g}}
parameters: {E: {path: materials.m.young, start: 1.1 GPa}}
refine: false
)");
  EXPECT_EQ(parameter(1).at("knowledge").get<std::string>(), "undetermined") << result.output;
  EXPECT_NE(result.output.find("say nothing about E, g"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace orthodyn::fit_nuisances_test
