// Derivatives of harmonic responses with respect to numbers of a scene, against closed forms and repeated analyses.
#include "lib/simulation/sensitivity/response_sensitivity.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::response_sensitivity_test {
namespace {

using Complex = std::complex<double>;

// A plate with oblique grain and a loss of each modulus, and with all other kinds of damping. Its pull along x is
// steady.
const std::string kPlate = R"(
analysis: harmonic
mesh: {type: box, size: [0.3, 0.2, 0.006], cells: [4, 3, 1], elements: hexahedra}
materials:
  wood: {type: orthotropic, density: 450, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 0.7e9, g23: 4e7, g13: 6e8}
regions: {body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 20 deg}}}
clamps: [{surface: x0}]
loads:
  - {surface: x1, force: [0, 0.3, 1], factor: {type: harmonic, phase: 30 deg}}
  - {surface: x1, force: [2000, 0, 0]}
damping: {stiffness: 2e-6, mass: 1}
output: {probes: {tip: {at: [0.3, 0, 0.006], fields: [velocity]}}}
)";
const std::string kHarmonic = R"(
harmonic:
  frequencies: [60 Hz, 110 Hz, 300 Hz]
  damping_ratio: 0.02
  losses: {wood: {young: [0.007, 0.02, 0.02], shear: [0.016, 0.017, 0.015]}}
  rtol: 1e-8
)";

struct Analysis {
  explicit Analysis(const Config& scene) : setup(set_up(scene)), response(setup) {}
  explicit Analysis(const std::string& scene) : Analysis(Config::from_text(scene, "scene.yaml")) {}
  std::vector<Complex> derivatives(const std::string& path, std::size_t column) const {
    const std::vector<SceneParameter> parameters{SceneParameter(setup.config, path)};
    const ResponseSensitivity sensitivity(setup.config, setup, response, {column}, parameters);
    std::vector<Complex> out;
    for (const double frequency : response.frequencies())
      out.push_back(sensitivity.derivatives(column, frequency).at(0));
    return out;
  }
  Setup setup;
  HarmonicResponse response;
};

// Central differences of repeated analyses converge to the derivative with order two.
void expect_order_two(const std::string& text, const std::string& path, const char* format, double value, double si,
                      double h, std::size_t column = 2) {
  const auto exact = Analysis(text).derivatives(path, column);
  const auto amplitudes = [&](double at) {
    Config scene = Config::from_text(text, "scene.yaml");
    scene.set_yaml(path, fmt::format(fmt::runtime(format), at));
    const Analysis changed(scene);
    std::vector<Complex> out;
    for (const double f : changed.response.frequencies()) out.push_back(changed.response.amplitude(column, f));
    return out;
  };
  std::vector<double> errors[2];
  for (const int i : {0, 1}) {
    const double step = h / (i + 1);
    const auto after = amplitudes(value + step), before = amplitudes(value - step);
    for (std::size_t f = 0; f < exact.size(); ++f)
      errors[i].push_back(std::abs((after[f] - before[f]) / (2 * step * si) - exact[f]));
  }
  for (std::size_t f = 0; f < exact.size(); ++f) {
    if (errors[0][f] < 1e-5 * std::abs(exact[f])) continue;  // hardly more than the tolerance of the amplitudes
    EXPECT_NEAR(std::log2(errors[0][f] / errors[1][f]), 2, 0.3)
        << path << ", frequency " << f << ": " << std::abs(exact[f]) << ", errors " << errors[0][f] << ", "
        << errors[1][f];
  }
}

TEST(ResponseSensitivity, IsTheLimitOfDifferences) {
  const std::string plate = kPlate + kHarmonic;
  expect_order_two(plate, "materials.wood.young.0", "{} GPa", 10.8, 1e9, 0.2);
  expect_order_two(plate, "materials.wood.density", "{}", 450, 1, 8);
  expect_order_two(plate, "regions.body.axes.angle", "{} deg", 20, std::numbers::pi / 180, 1);
  expect_order_two(plate, "mesh.size.2", "{}", 0.006, 1, 6e-5);
  expect_order_two(plate, "damping.stiffness", "{}", 2e-6, 1, 4e-7);
  expect_order_two(plate, "damping.mass", "{}", 1, 1, 0.4);
  expect_order_two(plate, "harmonic.damping_ratio", "{}", 0.02, 1, 0.004);
  expect_order_two(plate, "harmonic.losses.wood.young.0", "{}", 0.007, 1, 0.002);
  expect_order_two(plate, "loads.1.force.0", "{}", 2000, 1, 50);
}

// A free body shows its rigid motion; a shaken one the motion of its base.
TEST(ResponseSensitivity, IsTheLimitOfDifferencesForFreeAndForShakenBodies) {
  const std::string body = R"(
analysis: harmonic
mesh: {type: box, size: [0.3, 0.2, 0.006], cells: [4, 3, 1], elements: hexahedra}
materials: {m: {type: isotropic, density: 450, young: 1e10, nu: 0.3}}
output: {probes: {tip: {at: [0.3, 0, 0.006], fields: [acceleration]}}}
harmonic: {frequencies: [20 Hz, 300 Hz], losses: {m: {factor: 0.02}}, rtol: 1e-8)";
  const std::string free = body + "}\nloads: [{surface: x1, force: [0, 0.3, 1], factor: {type: harmonic}}]\n";
  const std::string shaken = body + ", base_acceleration: [0, 1, 2]}\nclamps: [{surface: x0}]\n";
  for (const std::string& scene : {free, shaken}) {
    expect_order_two(scene, "materials.m.young", "{} GPa", 10, 1e9, 0.2);
    expect_order_two(scene, "materials.m.density", "{}", 450, 1, 8);
    expect_order_two(scene, "mesh.size.2", "{}", 0.006, 1, 6e-5);
    expect_order_two(scene, "harmonic.losses.m.factor", "{}", 0.02, 1, 0.016);
  }
  expect_order_two(shaken, "harmonic.base_acceleration.2", "{}", 2, 1, 0.1);
}

// The basis for the loads alone would not do: the derivative needs the response to a force at the probe, too.
TEST(ResponseSensitivity, IsAccurateToTheToleranceOfTheAmplitudes) {
  const auto derivatives = [&](const char* rtol) {
    Config scene = Config::from_text(kPlate + kHarmonic, "scene.yaml");
    scene.set_yaml("harmonic.rtol", rtol);
    return Analysis(scene).derivatives("materials.wood.g12", 2);
  };
  const auto exact = derivatives("1e-9");
  double before = 1;
  for (const auto& [text, rtol] : {std::pair{"1e-2", 1e-2}, {"1e-4", 1e-4}, {"1e-6", 1e-6}}) {
    const auto found = derivatives(text);
    double error = 0;
    for (std::size_t f = 0; f < exact.size(); ++f)
      error = std::max(error, std::abs(found[f] - exact[f]) / std::abs(exact[f]));
    EXPECT_LT(error, 10 * rtol) << text;
    EXPECT_LE(error, before) << text;
    before = error;
  }
}

// The amplitude is proportional to the load and its phase does not depend on it.
TEST(ResponseSensitivity, HasTheSlopesOfAmplitudeAndPhase) {
  const std::string plate = kPlate + kHarmonic;
  const Analysis base(plate);
  const auto of_load = base.derivatives("loads.0.force.2", 2), of_side = base.derivatives("loads.0.force.1", 2);
  for (std::size_t f = 0; f < of_load.size(); ++f) {
    const Complex a = base.response.amplitude(2, base.response.frequencies()[f]);
    EXPECT_NEAR(amplitude_slope(a, of_load[f]) + 0.3 * amplitude_slope(a, of_side[f]), std::abs(a), 1e-6 * std::abs(a));
    EXPECT_NEAR(phase_slope(a, of_load[f]) + 0.3 * phase_slope(a, of_side[f]), 0, 1e-6);
  }
}

class ResponseSensitivities : public InFolder {};

TEST_F(ResponseSensitivities, AreATableOfTheRun) {
  write("plate.yaml", kPlate + kHarmonic + "sensitivities: [harmonic.losses.wood.young.0, materials.wood.young.0]\n");
  const auto result = orthodyn("run plate.yaml --out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("out/sensitivities.csv"), std::string::npos) << result.output;
  const std::string table = read_text(folder_ / "out/sensitivities.csv");
  for (const char* column : {"d tip.velocity.z / d materials.wood.young.0 [m/s / SI unit]",
                             "d tip.velocity.z.phase / d harmonic.losses.wood.young.0 [deg / SI unit]"})
    EXPECT_NE(table.find(column), std::string::npos) << column << "\nin " << table.substr(0, 600);
  const auto rows = read_rows(folder_ / "out/sensitivities.csv");
  ASSERT_EQ(rows.size(), 3u);
  const auto slope = [&](const char* path, std::size_t column) {
    const Analysis plate(kPlate + kHarmonic);
    const Complex a = plate.response.amplitude(2, 110);
    return amplitude_slope(a, plate.derivatives(path, column)[1]);
  };
  EXPECT_NEAR(rows[1][1 + 2 * 4 + 2], slope("materials.wood.young.0", 2),
              1e-4 * std::abs(slope("materials.wood.young.0", 2)));
}

TEST_F(ResponseSensitivities, AreRefusedWhereTheyAreNotComputed) {
  const struct {
    const char *path, *set, *says;
  } cases[] = {
      {"harmonic.rtol", "", "is no number of the model"},
      {"materials.wood.young.0", " --set output.probes.tip.fields=[nodal_stress]", "give a probe one of these"}};
  for (const auto& [path, set, says] : cases) {
    write("plate.yaml", kPlate + kHarmonic + "sensitivities: [" + path + "]\n");
    const auto result = orthodyn(std::string("run plate.yaml --out out") + set);
    EXPECT_EQ(result.exit_code, 2) << path << "\n" << result.output;
    EXPECT_NE(result.output.find(says), std::string::npos) << path << "\n" << result.output;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << path;
  }
}

}  // namespace
}  // namespace orthodyn::response_sensitivity_test
