// `orthodyn fit` as a user meets it: known parameters are recovered, mistakes are refused before anything runs.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <vector>

#include "lib/simulation/output/json.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::fit_test {
namespace {

// A strip with oblique grain under tension.
const char* const kStrip = R"(
analysis: static
mesh: {type: box, size: [0.12, 0.02, 0.003], cells: [4, 2, 1], elements: hexahedra}
materials:
  ply: {type: orthotropic, density: 1600, young: [40 GPa, 10 GPa, 10 GPa], nu12: 0.28, nu23: 0.4, nu13: 0.28,
        g12: 4 GPa, g23: 3.5 GPa, g13: 4 GPa}
regions: {body: {material: ply, axes: {type: axis_angle, axis: [0, 0, 1], angle: 25 deg}}}
clamps: [{surface: x0}]
loads: [{surface: x1, traction: [20 MPa, 0, 0]}]
output: {probes: {middle: {at: [0.06, 0.01, 0.003], fields: [displacement, nodal_strain]},
                  tip: {at: [0.12, 0.01, 0.003]}}}
)";

// A bar under tension: u = F L / (E A) = 2.5 um.
const char* const kBar = R"(
analysis: static
mesh: {type: box, size: [0.5, 0.1, 0.2], cells: [2, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1 GPa, nu: 0}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [100, 0, 0]}]
output: {probes: {end: {at: [0.5, 0, 0]}}}
)";

const std::vector<std::string> kQuantities{"middle.nodal_strain.11", "middle.nodal_strain.22", "middle.nodal_strain.12",
                                           "tip.displacement.x", "tip.displacement.y"};

class FitCommand : public InFolder {
 protected:
  FitCommand() { write("strip.yaml", kStrip); }

  CommandResult fit(const std::string& text) const {
    write("f.yaml", text);
    return orthodyn("fit f.yaml --no-report");
  }
  Json table() const { return Json::parse(read_text(folder_ / "out/fits/f/fit.json")); }
  Json parameter(std::size_t number) const { return table().at("parameters").at(number); }

  // Values of the quantities in equilibrium.
  std::vector<double> values() const {
    std::string text = "scene: strip.yaml\nvary: {materials.ply.density: [1600]}\nquantities:\n";
    for (std::size_t i = 0; i < kQuantities.size(); ++i)
      text += fmt::format("  q{}: {{quantity: {}}}\n", i, kQuantities[i]);
    write("s.yaml", text);
    EXPECT_EQ(orthodyn("sweep s.yaml --no-report --quiet").exit_code, 0);
    const Json point = Json::parse(read_text(folder_ / "out/sweeps/s/sweep.json")).at("points").at(0);
    std::vector<double> out;
    for (std::size_t i = 0; i < kQuantities.size(); ++i)
      out.push_back(point.at("metrics").at(fmt::format("q{}", i)).get<double>());
    return out;
  }

  // A fit of the strip with these measured values.
  std::string strip_fit(const std::vector<double>& measured, const std::string& parameters) const {
    std::string text = "experiments:\n  tension:\n    scene: strip.yaml\n    measured:\n";
    for (std::size_t i = 0; i < kQuantities.size(); ++i)
      text += fmt::format("      - {{quantity: {}, value: {:.16g}, relative: 0.01}}\n", kQuantities[i], measured[i]);
    return text + "parameters:\n" + parameters;
  }
};

const char* const kFour = R"(
  E1: {path: materials.ply.young.0, start: 30 GPa}
  E2: {path: materials.ply.young.1, start: 13 GPa}
  angle: {path: regions.body.axes.angle, start: 20 deg}
  nu12: {path: materials.ply.nu12, start: 0.45}
)";

TEST_F(FitCommand, RecoversKnownParametersOfAnEquilibrium) {
  const std::vector<double> measured = values();
  const auto result = fit(strip_fit(measured, kFour));
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const double expected[] = {40, 10, 25, 0.28};
  for (std::size_t p = 0; p < 4; ++p)
    EXPECT_NEAR(parameter(p).at("value").get<double>(), expected[p], 1e-6 * expected[p]) << p;
  EXPECT_LT(table().at("noise").at("chi_square").get<double>(), 1e-8);
  const auto runs = table().at("runs").get<int>();
  EXPECT_GE(runs, 4);

  // The same fit again finds its runs on disk, and gives the same answer.
  ASSERT_EQ(orthodyn("fit f.yaml --no-report --quiet").exit_code, 0);
  EXPECT_EQ(table().at("runs").get<int>(), 0);
  EXPECT_NEAR(parameter(0).at("value").get<double>(), 40, 4e-5);

  // A scene that includes the fitted material has the measured values.
  std::string use = kStrip;
  const std::size_t begin = use.find("{type: orthotropic"), end = use.find("regions:");
  write("strip.yaml", use.replace(begin, end - begin, "{include: out/fits/f/ply.yaml}\n"));
  const std::vector<double> again = values();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(again[i], measured[i], 1e-5 * std::abs(measured[i])) << i;
}

// The standard deviation of one parameter is that of the weighted derivatives: du/dE = -u / E for one displacement.
TEST_F(FitCommand, GivesTheIntervalOfLinearPropagation) {
  write("bar.yaml", kBar);
  const auto result = fit(R"(
experiments:
  bar: {scene: bar.yaml, measured: [{quantity: end.displacement.x, value: 2.0 um, deviation: 0.02 um}]}
parameters: {E: {path: materials.m.young, start: 3 GPa}}
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NEAR(parameter(0).at("value").get<double>(), 1.25, 1e-6);  // u = F L / (E A) = 2.5 um at 1 GPa
  EXPECT_NEAR(parameter(0).at("deviation").get<double>(), 0.0125, 1e-6);
  EXPECT_NEAR(parameter(0).at("high").get<double>(), 1.25 * std::exp(0.01 * 1.959964), 1e-6);
  EXPECT_NE(result.output.find("as many parameters as measured values"), std::string::npos) << result.output;
}

// The 95 % intervals of three parameters hold the truth in most of 20 fits to values with other random errors. Each
// count is binomial: with 95 % it is below 15 in one case of 10,000. tools/bench/fit_coverage.py repeats this 200
// times.
TEST_F(FitCommand, ItsIntervalsHoldTheTruth) {
  constexpr int kRepetitions = 20;
  const std::vector<double> exact = values();
  const std::vector<std::pair<std::string, double>> truth{{"E1", 40}, {"E2", 10}, {"angle", 25}};
  std::mt19937_64 generator(1);
  std::normal_distribution<double> noise(1, 0.01);
  std::map<std::string, int> held;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    std::vector<double> measured = exact;
    for (double& value : measured) value *= noise(generator);
    const auto result = fit(strip_fit(measured, R"(
  E1: {path: materials.ply.young.0, start: 36 GPa}
  E2: {path: materials.ply.young.1, start: 11 GPa}
  angle: {path: regions.body.axes.angle, start: 23 deg}
refine: false
)"));
    ASSERT_EQ(result.exit_code, 0) << result.output;
    for (std::size_t p = 0; p < truth.size(); ++p)
      held[truth[p].first] += parameter(p).at("low").get<double>() <= truth[p].second &&
                              truth[p].second <= parameter(p).at("high").get<double>();
    fs::remove_all(folder_ / "out");
  }
  for (const auto& [name, value] : truth) EXPECT_GE(held[name], 15) << name;
}

// From 100 GPa the first step is to a negative modulus' side of zero displacement and its run fails: a shorter one
// follows.
TEST_F(FitCommand, GoesOnAfterAFailedRun) {
  write("bar.yaml", kBar);
  const auto result = fit(R"(
experiments:
  bar: {scene: bar.yaml, measured: [{quantity: end.displacement.x, value: 2.5 um, relative: 0.01}]}
parameters: {E: {path: materials.m.young, start: 100 GPa}}
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("step rejected: "), std::string::npos) << result.output;  // with the reason
  EXPECT_NEAR(parameter(0).at("value").get<double>(), 1, 1e-6);
}

// The amplitude and the damping of a motion, whose derivatives come with its run.
TEST_F(FitCommand, RecoversParametersOfAMotion) {
  const std::string scene = std::string(kBar).replace(std::string(kBar).find("analysis: static\n"), 17, "") + R"(
damping: {stiffness: 20 us}
time: {end: 0.002}
integrator: {type: cvode_bdf, rtol: 1e-7}
)";
  write("bar.yaml", scene);
  write("truth.yaml", scene + "sensitivities: []\n");
  ASSERT_EQ(orthodyn("run truth.yaml --quiet --out truth --set output.frames=20").exit_code, 0);
  write("data.csv", read_text(folder_ / "truth" / "probes.csv"));
  const auto result = fit(R"(
experiments:
  bar:
    scene: bar.yaml
    measured: [{quantity: end.displacement.x, table: data.csv, column: "end.displacement.x [m]", deviation: 0.01 um}]
parameters:
  E: {path: materials.m.young, start: 1.1 GPa}
  damping: {path: damping.stiffness, start: 15 us}
refine: false
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NEAR(parameter(0).at("value").get<double>(), 1, 1e-4);
  EXPECT_NEAR(parameter(1).at("value").get<double>(), 20, 0.02);
  EXPECT_LT(table().at("runs").get<int>(), 20);
}

// A prior counts as one more measured value: the mean of two equally precise ones.
TEST_F(FitCommand, CountsAPriorAsAMeasuredValue) {
  write("bar.yaml", kBar);
  const auto result = fit(R"(
experiments:
  bar: {scene: bar.yaml, measured: [{quantity: end.displacement.x, value: 2.5 um, deviation: 0.1 um}]}
parameters:
  F: {path: loads.0.force.0, start: 100, prior: {value: 110, deviation: 4}}
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NEAR(parameter(0).at("value").get<double>(), 105, 1e-5);
  EXPECT_NEAR(parameter(0).at("deviation").get<double>(), 4 / std::sqrt(2), 1e-5);
  // chi-square: (2.625 - 2.5)^2 / 0.1^2 + (105 - 110)^2 / 4^2; BIC: one parameter, two residuals
  const Json noise = table().at("noise");
  const double chi_square = 1.5625 + 1.5625;
  EXPECT_NEAR(noise.at("chi_square").get<double>(), chi_square, 1e-4);
  EXPECT_NEAR(noise.at("bic").get<double>(), chi_square + std::log(2), 1e-4);
}

// Data that no stable material explains: the search ends at a stable one and says that it does not fit.
TEST_F(FitCommand, EndsAtAStableMaterialForDataThatNoneExplains) {
  std::vector<double> measured = values();
  measured[0] *= 3, measured[1] *= -4;
  const auto result = fit(strip_fit(measured, std::string(kFour) + "iterations: 12\nrefine: false\n"));
  EXPECT_NE(result.output.find("times as large as the stated deviations"), std::string::npos) << result.output;
  const Json iterations = table().at("attempts").at(0).at("iterations");
  EXPECT_LT(iterations.back().at("chi_square").get<double>(), 0.9 * iterations.front().at("chi_square").get<double>());
  const double e1 = parameter(0).at("value").get<double>(), e2 = parameter(1).at("value").get<double>();
  const double nu12 = parameter(3).at("value").get<double>();
  EXPECT_LT(std::abs(nu12) * std::sqrt(e2 / e1), 1);
}

// A free plate by its frequencies; the mode that was not measured is left out.
TEST_F(FitCommand, RecoversModuliFromNaturalFrequencies) {
  write("plate.yaml", R"(
mesh: {type: box, size: [0.3, 0.2, 0.008], cells: [3, 2, 1], elements: hexahedra}
materials:
  wood: {type: orthotropic, density: 430, young: [11 GPa, 0.9 GPa, 0.5 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.42,
         g12: 0.75 GPa, g23: 0.04 GPa, g13: 0.72 GPa}
regions: {body: {material: wood}}
time: {end: 1}
)");
  ASSERT_EQ(orthodyn("modes plate.yaml -n 12 --out modes --quiet").exit_code, 0);
  std::istringstream modes(read_text(folder_ / "modes/modes.csv"));
  std::string line, list;
  for (int row = 0; std::getline(modes, line); ++row) {
    if (row <= 6) continue;  // the heading and six rigid modes
    const std::size_t comma = line.find(',');
    const std::string frequency = row == 9 ? "null" : line.substr(comma + 1, line.find(',', comma + 1) - comma - 1);
    list += (list.empty() ? "" : ", ") + frequency;
  }
  const auto result = fit("experiments: {plate: {scene: plate.yaml, measured: [{frequencies: [" + list +
                          "], relative: 0.005}]}}\nrefine: false\nparameters:\n"
                          "  E1: {path: materials.wood.young.0, start: 8 GPa}\n"
                          "  E2: {path: materials.wood.young.1, start: 1.2 GPa}\n"
                          "  G12: {path: materials.wood.g12, start: 0.6 GPa}\n");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(table().at("data").size(), 5u);
  EXPECT_NEAR(parameter(0).at("value").get<double>(), 11, 11e-6);
  EXPECT_NEAR(parameter(1).at("value").get<double>(), 0.9, 0.9e-6);
  EXPECT_NEAR(parameter(2).at("value").get<double>(), 0.75, 0.75e-6);
}

TEST_F(FitCommand, RefusesMistakesBeforeAnythingRuns) {
  write("gap.csv", "t [s],z [mm]\n0.1,x\n");
  write("late.csv", "t [s],z [mm]\n0.1,1\n0.5,1\n");
  write("mass.csv", "t [s],z [kg]\n0.1,1\n");
  write("swing.yaml", R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [2, 1, 1]}
materials: {ply: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, 0.1]}]
time: {end: 0.2}
output: {probes: {tip: {at: [1, 0.1, 0.1]}}}
)");
  const std::string swing =
      "experiments: {t: {scene: swing.yaml, measured: [{quantity: tip.displacement.z, deviation: 1 um, ";
  const std::string young = "parameters: {E: materials.ply.young}\n";
  const std::string tension = "experiments: {t: {scene: strip.yaml, measured: [{quantity: tip.displacement.x, ";
  const std::string value = "value: 0.1 mm, deviation: 1 um}]}}\n", e1 = "parameters: {E1: materials.ply.young.0}\n";
  const std::pair<std::string, const char*> wrong[] = {
      {tension + value + "parameters: {E1: materials.ply.yung.0}\n", "no key 'yung'; did you mean 'young'?"},
      {tension + "value: 0.1 kg, deviation: 1 um}]}}\n" + e1, "kg"},
      {tension + "value: 0.1 mm}]}}\n" + e1, "give the standard deviation"},
      {tension + "value: 0.1 mm, at: 0.2, deviation: 1 um}]}}\n" + e1, "this scene is static"},
      {tension + "table: gap.csv, column: z, deviation: 1 um}]}}\n" + e1, "this scene is static"},
      {swing + "table: gap.csv, column: 'z [mm]'}]}}\n" + young, "gap.csv:2: column z [mm]: expected a finite number"},
      {swing + "table: gap.csv, column: y}]}}\n" + young, "gap.csv"},
      {swing + "table: late.csv, column: 'z [mm]'}]}}\n" + young, "the value is measured at 0.5 s"},
      {swing + "table: late.csv, column: y}]}}\n" + young, "late.csv has no column 'y'"},
      {swing + "table: mass.csv, column: 'z [kg]'}]}}\n" + young, "expected a length (m)"},
      {tension + value + "parameters: {E1: materials.ply.young.0, E2: materials.ply.young.1}\n",
       "1 measured value cannot determine 2 parameters"},
      {tension + value + "parameters: {nu: {path: materials.ply.nu12, lower: 0}}\n", "remove lower, upper and scale"},
      {tension + value + "parameters: {E1: {path: materials.ply.young.0, start: 1 kg}}\n", "kg"},
      {tension + value + e1 + "candidates: {c: {scene: strip.yaml, measured: [{mode: 1, value: 3, deviation: 1}]}}\n",
       "a candidate has no measured values"},
      {"experiments: {t: {scene: strip.yaml, measured: [{quantity: tap.displacement.x, " + value + e1,
       "unknown quantity 'tap.displacement.x'"}};
  for (const auto& [text, message] : wrong) {
    const auto result = fit(text);
    EXPECT_EQ(result.exit_code, 2) << text;
    EXPECT_NE(result.output.find(message), std::string::npos) << message << "\nin: " << result.output;
    EXPECT_FALSE(fs::exists(folder_ / "out/fits/f/points")) << text;
  }
}

// Each value has its own weight: the deflections of two lines, one of which is wrong by a factor and hardly counts.
TEST_F(FitCommand, WeighsEachValueOfATableByItsOwnDeviation) {
  write("swing.yaml", R"(
mesh: {type: box, size: [1, 0.1, 0.1], cells: [2, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
elasticity: {kinematics: linear}
damping: {mass: 2000}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [1, 0, 0]}]
time: {end: 20}
integrator: {type: cvode_bdf, rtol: 1e-7}
output: {probes: {tip: {at: [1, 0.1, 0.1]}}}
)");
  const double at_rest = 1 / (1e6 * 0.01);  // m; the body creeps to it
  write("data.csv", fmt::format("t [s],x [m],error [m]\n18,{:.17g},1e-9\n20,{:.17g},1e-3\n", at_rest / 2, 2 * at_rest));
  const auto result = fit(R"(
experiments:
  swing:
    scene: swing.yaml
    measured: [{quantity: tip.displacement.x, table: data.csv, column: 'x [m]', deviation_column: 'error [m]'}]
parameters: {E: {path: materials.m.young, start: 1.5e6}}
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NEAR(parameter(0).at("value").get<double>(), 2e6, 2e3);
  const auto refused = fit(R"(
experiments:
  swing: {scene: swing.yaml, measured: [{frequencies: [5 Hz, 6 Hz], deviations: [0.1 Hz]}]}
parameters: {E: materials.m.young}
)");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("give one for each"), std::string::npos) << refused.output;
}

TEST_F(FitCommand, RefusesAParameterWithoutEffect) {
  const auto result = fit(strip_fit(values(), "  rho: materials.ply.density\n"));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("changes none of the measured quantities"), std::string::npos) << result.output;
}

// A measurement done twice shrinks the standard deviation by sqrt(2); a hundred times as precise one by almost 100.
TEST_F(FitCommand, RanksCandidates) {
  write("bar.yaml", kBar);
  const auto result = fit(R"(
experiments:
  bar: {scene: bar.yaml, measured: [{quantity: end.displacement.x, value: 2.5 um, deviation: 0.025 um}]}
parameters: {E: materials.m.young}
candidates:
  again: {scene: bar.yaml, measured: [{quantity: end.displacement.x, deviation: 0.025 um}]}
  precise: {scene: bar.yaml, measured: [{quantity: energy.elastic, deviation: 1.25e-8 J}]}
)");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const Json candidates = table().at("candidates");
  const auto deviation = [&](std::size_t k) { return candidates.at(k).at("deviations").at(0).get<double>(); };
  EXPECT_NEAR(candidates.at(0).at("determinant_gain").get<double>(), std::sqrt(2), 1e-3);
  EXPECT_NEAR(deviation(0), 0.01 / std::sqrt(2), 1e-5);  // GPa
  EXPECT_NEAR(deviation(1), 1e-4, 1e-6);                 // the energy F u / 2 = 1.25e-4 J
  EXPECT_NE(result.output.find("'precise' would tell most"), std::string::npos) << result.output;
}

// Nine equal values and an outlier: the mean takes a tenth of it, Cauchy's loss hardly any.
TEST_F(FitCommand, GivesOutliersLessWeightByALoss) {
  write("bar.yaml", kBar);
  std::string text = "experiments:\n  bar:\n    scene: bar.yaml\n    measured:\n";
  for (int i = 0; i < 10; ++i)
    text += fmt::format("      - {{quantity: end.displacement.x, value: {} um, deviation: 0.025 um}}\n",
                        i == 4 ? 3.5 : 2.5);
  text += "parameters: {E: {path: materials.m.young, start: 1.2 GPa}}\nrefine: false\n";
  ASSERT_EQ(fit(text).exit_code, 0);
  EXPECT_NEAR(parameter(0).at("value").get<double>(), 2.5 / 2.6, 1e-6);
  EXPECT_GT(table().at("noise").at("factor").get<double>(), 5);
  ASSERT_EQ(fit(text + "loss: cauchy\n").exit_code, 0);
  EXPECT_NEAR(parameter(0).at("value").get<double>(), 1, 2e-3);
  EXPECT_EQ(table().at("noise").at("factor").get<double>(), 1);
}

// A ratio of zero has no scale for a change: refused, and not silently left out.
TEST_F(FitCommand, RefusesANumberOfValueZero) {
  write("bar.yaml", kBar);
  const auto result = fit(R"(
experiments:
  bar: {scene: bar.yaml, measured: [{quantity: end.displacement.x, value: 2.5 um, deviation: 0.025 um}]}
parameters: {nu: materials.m.nu}
)");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.output.find("a parameter of value 0 has no scale"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace orthodyn::fit_test
