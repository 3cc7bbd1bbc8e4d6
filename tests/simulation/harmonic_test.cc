// Parts of harmonic analyses, and `orthodyn run` of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <sstream>

#include "lib/core/symmetric_eigen.h"
#include "lib/simulation/harmonic/frequency_grid.h"
#include "lib/simulation/harmonic/loss_stiffness.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::harmonic_test {
namespace {

const OrthotropicStiffness kWood{12e9, 1.2e9, 0.7e9, 0.6e9, 0.4e9, 0.5e9, 0.7e9, 0.05e9, 0.6e9};

TEST(LossOf, OfEqualFactorsIsAMultipleOfTheStiffness) {
  const MaterialLoss factor{.factor = 0.02}, quality{.quality = 50};
  for (const MaterialLoss& loss : {factor, quality}) {
    EXPECT_LT((voigt(loss_of(kWood, loss)) - 0.02 * voigt(kWood)).norm(), 1e-14 * voigt(kWood).norm());
    const IsotropicStiffness steel = isotropic_stiffness(210e9, 0.3);
    EXPECT_LT((voigt(loss_of(steel, loss)) - 0.02 * voigt(steel)).norm(), 1e-14 * voigt(steel).norm());
  }
}

// The compliance with complex moduli and real Poisson's ratios, inverted. Terms of second order in the factors are left
// out of the loss.
TEST(LossOf, IsTheImaginaryPartOfTheStiffnessWithComplexModuli) {
  const auto error = [](double size) {
    const MaterialLoss loss{.young = std::vector<double>{size, 3 * size, 4 * size},
                            .shear = std::vector<double>{3 * size, 5 * size, 2 * size}};
    const double eta[] = {size, 3 * size, 4 * size, 3 * size, 5 * size, 2 * size};
    const Mat6 at_rest = voigt(kWood).inverse();
    Eigen::Matrix<std::complex<double>, 6, 6> compliance = at_rest.cast<std::complex<double>>();
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        compliance(i, j) /= std::sqrt(std::complex<double>(1, eta[i])) * std::sqrt(std::complex<double>(1, eta[j]));
    return (voigt(loss_of(kWood, loss)) - Mat6(compliance.inverse().imag())).norm() / voigt(kWood).norm();
  };
  EXPECT_LT(error(0.01), 1e-4);
  EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 3, 0.3);
}

TEST(LossOf, RefusesFactorsByWhichAStrainGainsEnergy) {
  OrthotropicStiffness nearly_singular = kWood;
  nearly_singular.c12 = 0.99 * std::sqrt(kWood.c11 * kWood.c22);
  const MaterialLoss loss{.young = std::vector<double>{0.001, 0.5, 0.5}, .shear = std::vector<double>{0.1, 0.1, 0.1}};
  EXPECT_THROW(loss_of(nearly_singular, loss), ConfigError);
}

TEST(FrequencyGrid, HasTheResonancesAndAscends) {
  const Harmonic harmonic{.from = 100, .to = 1000, .points = 5};
  const std::vector<Resonance> resonances{{0, 0}, {50, 0.01}, {300, 0.01}, {302, 0.01}, {999, 0.1}, {1200, 0.01}};
  const auto grid = frequency_grid(harmonic, resonances);
  EXPECT_EQ(grid.front(), 100);
  EXPECT_EQ(grid.back(), 1000);
  EXPECT_TRUE(std::is_sorted(grid.begin(), grid.end(), std::less_equal<>()));
  for (const double f : {300.0, 302.0, 999.0, 300 - 0.5 * 300 * 0.01 * 21})
    EXPECT_TRUE(std::binary_search(grid.begin(), grid.end(), f)) << f;
  EXPECT_TRUE(missed_resonances(grid, resonances).empty());
  const auto without = frequency_grid({.from = 100, .to = 1000, .points = 5, .resonances = false}, resonances);
  EXPECT_EQ(without.size(), 5u);
  EXPECT_NEAR(without[2], std::sqrt(100 * 1000), 1e-9);
  EXPECT_EQ(missed_resonances(without, resonances), (std::vector<int>{3, 4}));
  const auto linear = frequency_grid({.from = 100, .to = 1000, .points = 4, .spacing = Spacing::linear}, {});
  EXPECT_EQ(linear, (std::vector<double>{100, 400, 700, 1000}));
  EXPECT_EQ(check_frequencies(linear, {}), linear);
  EXPECT_EQ(check_frequencies({7}, {3, 7, 20}), std::vector<double>{7});
  EXPECT_EQ(check_frequencies(linear, {50, 450}), (std::vector<double>{100, 400, 450, 700, 1000}));
}

const std::string kPlate = R"(analysis: harmonic
mesh: {type: box, size: [0.2, 0.1, 0.01], cells: [3, 2, 1], order: 2}
materials: {m: {type: isotropic, density: 450, young: 10e9, nu: 0.3}}
output: {probes: {tip: {at: [0.2, 0.1, 0.01]}}}
)";
const std::string kClamp = "clamps: [{surface: x0}]\n";
const std::string kTap =
    "terms: [{type: point_load, nearest: [0.2, 0.1, 0.01], force: [0, 0, 1], factor: {type: harmonic}}]\n";
const std::string kRange = "harmonic: {from: 100, to: 2000, points: 20, damping_ratio: 0.01}\n";

class HarmonicRun : public InFolder {};

TEST_F(HarmonicRun, WritesResponseAndModes) {
  write("plate.yaml", kPlate + kClamp + kTap + kRange);
  const auto result = orthodyn("run plate.yaml --out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto rows = read_rows(folder_ / "out/response.csv"), modes = read_rows(folder_ / "out/modes.csv");
  EXPECT_EQ(rows.front()[0], 100);
  EXPECT_EQ(rows.back()[0], 2000);
  EXPECT_GT(rows.size(), 20u);
  EXPECT_EQ(rows.front().size(), 7u);
  ASSERT_FALSE(modes.empty());
  EXPECT_NEAR(modes[0][2], 0.01, 1e-12);
  EXPECT_TRUE(fs::exists(folder_ / "out/modes/mode_001.vtu"));
  EXPECT_NE(read_text(folder_ / "out/run.json").find("\"analysis\": \"harmonic\""), std::string::npos);
  EXPECT_EQ(orthodyn("run out/scene.yaml --out again --quiet").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "out/response.csv"), read_text(folder_ / "again/response.csv"));
  EXPECT_EQ(orthodyn("check plate.yaml").exit_code, 0);
}

TEST_F(HarmonicRun, OfTheTemplateHasNoWarning) {
  ASSERT_EQ(orthodyn("init harmonic my.yaml").exit_code, 0);
  const auto result = orthodyn("run my.yaml --out out");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output.find("warning"), std::string::npos) << result.output;
}

TEST_F(HarmonicRun, OfAFreeBodyIsDoneWithoutClamps) {
  write("plate.yaml", kPlate + kTap + kRange);
  const auto result = orthodyn("run plate.yaml --out out");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(orthodyn("check plate.yaml").exit_code, 0);
}

TEST_F(HarmonicRun, WarnsOfResonancesBetweenTheFrequencies) {
  write("plate.yaml", kPlate + kClamp + kTap + "harmonic: {frequencies: [100, 2000], damping_ratio: 0.001}\n");
  const auto result = orthodyn("run plate.yaml --out out");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.output.find("the frequencies miss"), std::string::npos) << result.output;
}

TEST_F(HarmonicRun, RefusesWhatItCannotCompute) {
  const struct {
    std::string more, says;
  } cases[] = {
      {kClamp + kTap, "'harmonic' is missing"},
      {kClamp + kRange, "no load vibrates"},
      {kClamp + kTap + "harmonic: {from: 100, damping_ratio: 0.01}\n", "by 'from' and 'to'"},
      {kClamp + kTap + "harmonic: {from: 100, to: 50, damping_ratio: 0.01}\n", "'to' must be above 'from'"},
      {kClamp + kTap + "harmonic: {from: 100, to: 2000}\n", "nothing damps the vibration"},
      {kClamp + kTap + "harmonic: {from: 1, to: 2, losses: {wood: {factor: 0.1}}}\n", "unknown material 'wood'"},
      {kClamp + kTap + "harmonic: {frequencies: [1, 2], points: 3, damping_ratio: 0.1}\n", "belong to 'from' and 'to'"},
      {kClamp +
           "terms: [{type: spring, nearest: [0.2, 0, 0], stiffness: 1}]\nharmonic: {from: 1, to: 2, damping_ratio: "
           "0.1, base_acceleration: [0, 0, 1]}\n",
       "cannot be combined with harmonic.base_acceleration"},
      {kClamp + kTap + "harmonic: {from: 1, to: 900, losses: {m: {young: [0.1, 0.2, 0.1], shear: [0.1, 0.1, 0.1]}}}\n",
       "one loss factor"},
      {kClamp + kTap + "harmonic: {from: 10, to: 900, losses: {m: {factor: 0}}}\n", "nothing damps mode 1"},
      {kClamp + "terms: [{type: point_load, nearest: [0.2, 0, 0], force: [0, 0, 1], factor: {type: harmonic, phase: 90 "
                "deg}}]\n"
                "harmonic: {from: 10, to: 900, damping_ratio: 0.1, tap_seconds: 1}\n",
       "a tap has no phase"},
      {kClamp + kTap + "harmonic: {from: 1, to: 2, losses: {m: {}}}\n", "exactly one of: factor, quality, young"},
      {kClamp + kTap + kRange + "time: {end: 1}\n", "no effect in a harmonic analysis"},
      {kTap + "harmonic: {from: 1, to: 2, damping_ratio: 0.1, base_acceleration: [0, 0, 1]}\n", "needs supports"},
      {kTap + kRange + "gravity: [0, 0, -9.81]\n", "clamps"},
      {kClamp + kTap + kRange + "motions: [{surface: x1, translation: [0, 0, 1], factor: {type: constant}}]\n",
       "not supported in a harmonic analysis"},
      {kClamp + kTap + kRange + "loads: [{surface: x1, force: [1, 0, 0], factor: {type: ramp, end: 1}}]\n",
       "varies in time"},
      {kClamp + kTap + kRange +
           "expect: [{quantity: tip.displacement.z, take: max, value: 1, relative: 1, source: s, reason: r}]\n",
       "has no time"},
      {kClamp + kTap + kRange +
           "expect: [{quantity: tip.displacement.q, value: 1, relative: 1, source: s, reason: r}]\n",
       "unknown quantity 'tip.displacement.q'"}};
  for (const auto& [more, says] : cases) {
    write("plate.yaml", kPlate + more);
    const auto result = orthodyn("run plate.yaml --out out");
    EXPECT_EQ(result.exit_code, 2) << more << "\n" << result.output;
    EXPECT_NE(result.output.find(says), std::string::npos) << more << "\n" << result.output;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << more;
  }
}

TEST_F(HarmonicRun, RefusesFieldsWithoutAmplitude) {
  const std::string scene = kPlate + kClamp + kTap + kRange;
  for (const auto& [field, says] : {std::pair{"von_mises", "not linear"}, {"displacemnt", "did you mean"}}) {
    write("plate.yaml", scene);
    const auto result = orthodyn(fmt::format("run plate.yaml --out out --set 'output.probes.tip.fields=[{}]'", field));
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_NE(result.output.find(says), std::string::npos) << result.output;
  }
}

TEST_F(HarmonicRun, OtherAnalysesRefuseItsLoads) {
  write("plate.yaml", kPlate + kClamp + kTap + "time: {end: 1}\n");
  for (const char* analysis : {"dynamic", "static"}) {
    const auto result = orthodyn(fmt::format("run plate.yaml --out out --set analysis={}", analysis));
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_NE(result.output.find("needs analysis: harmonic"), std::string::npos) << result.output;
  }
}

// The first mode decays by exp(-2 pi zeta) in each period.
TEST_F(HarmonicRun, WritesTheSoundOfATap) {
  write("plate.yaml",
        kPlate + kClamp + kTap + "harmonic: {from: 100, to: 400, points: 20, damping_ratio: 0.01, tap_seconds: 0.2}\n");
  const auto result = orthodyn("run plate.yaml --out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto modes = read_rows(folder_ / "out/modes.csv");
  ASSERT_EQ(modes.size(), 1u);
  const std::string wav = read_text(folder_ / "out/taps/tip.wav");
  ASSERT_EQ(wav.size(), 44 + 2 * 8820u);
  EXPECT_EQ(wav.substr(0, 4) + wav.substr(8, 8), "RIFFWAVEfmt ");
  const auto sample = [&](std::size_t k) {
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(wav[44 + 2 * k + at]); };
    return static_cast<double>(static_cast<std::int16_t>(byte(0) | byte(1) << 8));
  };
  EXPECT_EQ(sample(0), std::lround(0.9 * 32767));
  std::vector<double> peaks;  // of successive periods
  for (std::size_t k = 1; k + 1 < 8820; ++k)
    if (sample(k) > 1000 && sample(k) >= sample(k - 1) && sample(k) > sample(k + 1)) peaks.push_back(sample(k));
  const auto periods = static_cast<std::size_t>(modes[0][1] * 0.15);
  ASSERT_GT(peaks.size(), periods);
  EXPECT_NEAR(std::log(peaks[0] / peaks[periods]) / static_cast<double>(periods),
              2 * std::numbers::pi * 0.01 / std::sqrt(1 - 1e-4), 1e-3);
}

// The peak of the response is at a natural frequency; a heavier plate has a lower one.
TEST_F(HarmonicRun, IsVerifiedSweptAndConverged) {
  write("plate.yaml", kPlate + kClamp + kTap + kRange + R"(expect:
  - {quantity: tip.displacement.z, frequency: 100 Hz, value: 0.01 mm, absolute: 1 mm, source: none, reason: wide}
  - {quantity: tip.displacement.z, frequency: 100 Hz, response: phase, value: 0 deg, absolute: 10 deg, source: s, reason: r}
  - {quantity: tip.displacement.z, response: peak_frequency, value: 190 Hz, relative: 0.2, source: s, reason: r}
)");
  const auto verified = orthodyn("verify plate.yaml");
  EXPECT_EQ(verified.exit_code, 0) << verified.output;
  write("sweep.yaml", R"(scene: plate.yaml
vary: {materials.m.density: {values: [450, 900]}}
quantities:
  peak: {quantity: tip.displacement.z, response: peak_frequency}
  size: {quantity: tip.displacement.z, frequency: 100 Hz}
)");
  const auto swept = orthodyn("sweep sweep.yaml --out swept");
  ASSERT_EQ(swept.exit_code, 0) << swept.output;
  std::istringstream text(read_text(folder_ / "swept/sweep.csv"));
  std::vector<std::vector<std::string>> table;
  for (std::string line, cell; std::getline(text, line);) {
    std::istringstream cells(line);
    table.emplace_back();
    while (std::getline(cells, cell, ',')) table.back().push_back(cell);
  }
  ASSERT_EQ(table.size(), 3u);
  const auto value = [&](const std::string& name, std::size_t row) {
    const auto starts = [&](const std::string& cell) { return cell.starts_with(name); };
    const auto column = std::find_if(table[0].begin(), table[0].end(), starts) - table[0].begin();
    return std::stod(table[row].at(static_cast<std::size_t>(column)));
  };
  EXPECT_NEAR(value("peak", 1) / value("peak", 2), std::sqrt(2), 1e-4);  // proportional to 1 / sqrt(density)
  EXPECT_GT(value("peak", 1), 100);
  EXPECT_LT(value("size", 1), 1e-3);
  const auto refused = orthodyn("converge plate.yaml --quantity 'max of tip.displacement.z'");
  EXPECT_EQ(refused.exit_code, 2) << refused.output;
  const auto without = orthodyn("converge plate.yaml --quantity 'amplitude of tip.displacement.z'");
  EXPECT_EQ(without.exit_code, 2) << without.output;
  const auto converged = orthodyn(
      "converge plate.yaml --levels 2 --quantity 'peak_frequency of tip.displacement.z' "
      "--quantity 'amplitude of tip.displacement.z at 100 Hz' --out c");
  ASSERT_EQ(converged.exit_code, 0) << converged.output;
  EXPECT_NE(converged.output.find(" Hz"), std::string::npos) << converged.output;
}

}  // namespace
}  // namespace orthodyn::harmonic_test
