// Derivatives of natural frequencies with respect to numbers of a scene, against closed forms and repeated analyses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/simulation/sensitivity/frequency_sensitivity.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::sensitivity_test {
namespace {

const std::string kPlate = R"(
mesh: {type: box, size: [0.4, 0.3, 0.004], cells: [4, 3, 1]}
materials:
  wood: {type: orthotropic, density: 450, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 0.7e9, g23: 4e7, g13: 6e8}
regions: {body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 20 deg}}}
time: {end: 1}
)";

struct Analysis {
  explicit Analysis(const std::string& scene, int count = 10)
      : setup(set_up(Config::from_text(scene, "scene.yaml"))), modal(setup, count, false) {}
  Setup setup;
  ModalAnalysis modal;
  std::vector<double> derivatives(const std::string& path) const {
    return frequency_sensitivities(setup.config, modal, scene_parameters(setup.config, {path})).at(0).derivatives;
  }
  double frequency(std::size_t mode) const { return modal.modes().modes[mode].frequency(); }
};

// All frequencies are proportional to 1 / sqrt(density), and to the root of a common factor of all moduli.
TEST(FrequencySensitivity, OfDensityAndOfAllModuliIsThatOfARoot) {
  const Analysis plate(kPlate);
  const auto by_density = plate.derivatives("materials.wood.density");
  std::vector<double> by_moduli(10, 0);
  const std::pair<const char*, double> moduli[] = {{"young.0", 10.8e9}, {"young.1", 0.84e9}, {"young.2", 0.46e9},
                                                   {"g12", 0.7e9},      {"g23", 4e7},        {"g13", 6e8}};
  for (const auto& [key, value] : moduli) {
    const auto own = plate.derivatives(std::string("materials.wood.") + key);
    for (std::size_t k = 6; k < 10; ++k) by_moduli[k] += value * own[k];
  }
  for (std::size_t k = 6; k < 10; ++k) {
    EXPECT_NEAR(by_density[k], -plate.frequency(k) / (2 * 450), 1e-8 * plate.frequency(k) / 900) << k;
    EXPECT_NEAR(by_moduli[k], plate.frequency(k) / 2, 1e-8 * plate.frequency(k)) << k;
  }
  for (std::size_t k = 0; k < 6; ++k) EXPECT_TRUE(std::isnan(by_density[k]));
}

// Central differences of repeated analyses converge to the derivative with order two.
TEST(FrequencySensitivity, IsTheLimitOfDifferences) {
  const Analysis plate(kPlate);
  const struct {
    const char *path, *format;
    double value, si, step;
  } parameters[] = {{"regions.body.axes.angle", "{} deg", 20, std::numbers::pi / 180, 0.04},
                    {"materials.wood.g12", "{}", 0.7e9, 1, 0.04},
                    {"mesh.size.2", "{}", 0.004, 1, 0.16}};
  for (const auto& p : parameters) {
    const auto exact = plate.derivatives(p.path);
    const auto error = [&](double share, std::size_t mode) {
      const auto frequency = [&](double value) {
        Config scene = Config::from_text(kPlate, "scene.yaml");
        scene.set_yaml(p.path, fmt::format(fmt::runtime(p.format), value));
        const orthodyn::Setup setup = set_up(scene);
        return ModalAnalysis(setup, 10, false).modes().modes[mode].frequency();
      };
      const double h = share * p.value;
      return (frequency(p.value + h) - frequency(p.value - h)) / (2 * h * p.si) - exact[mode];
    };
    for (const std::size_t mode : {6, 7, 8})
      EXPECT_NEAR(std::log2(std::abs(error(p.step, mode) / error(p.step / 2, mode))), 2, 0.3)
          << p.path << ", mode " << mode;
  }
}

// A square bar bends alike in two planes. If it becomes higher, one frequency grows with the height and one hardly
// changes.
TEST(FrequencySensitivity, OfEqualFrequenciesIsThatOfTheirBranches) {
  const Analysis bar(R"(
mesh: {type: box, size: [1, 0.05, 0.05], cells: [8, 2, 2], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
time: {end: 1}
)",
                     4);
  ASSERT_NEAR(bar.frequency(0) / bar.frequency(1), 1, 1e-9);
  const auto by_height = bar.derivatives("mesh.size.2");
  const double in_height = bar.frequency(0) / 0.05;  // of a slender beam
  EXPECT_NEAR(by_height[0], 0, 0.02 * in_height);
  EXPECT_NEAR(by_height[1], in_height, 0.02 * in_height);
}

// Modes 3 and 4 have equal frequencies. Mode 3 has the same derivative whether or not mode 4 is requested.
TEST(FrequencySensitivity, DoesNotDependOnTheNumberOfModes) {
  const std::string bar = R"(
mesh: {type: box, size: [1, 0.05, 0.05], cells: [8, 2, 2], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.4999}}
clamps: [{surface: x0}]
time: {end: 1}
)";
  const Analysis three(bar, 3), four(bar, 4);
  ASSERT_NEAR(four.frequency(2) / four.frequency(3), 1, 3e-8);
  for (const char* path : {"mesh.size.2", "materials.m.nu"}) {  // nu may grow by 0.0001 only
    const auto of_three = three.derivatives(path), of_four = four.derivatives(path);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(of_three[k], of_four[k], 1e-6 * std::abs(of_four[1])) << path << k;
  }
}

// A plate 400 times wider than thick: round-off in its frequencies is 1e-6, that in the derivatives is not larger.
TEST(FrequencySensitivity, IsAccurateForThinPlates) {
  const Analysis plate(R"(
mesh: {type: box, size: [0.4, 0.3, 0.001], cells: [12, 9, 1]}
materials: {m: {type: isotropic, density: 450, young: 1e10, nu: 0.3}}
time: {end: 1}
)",
                       8);
  const auto by_young = plate.derivatives("materials.m.young");
  for (std::size_t k = 6; k < 8; ++k) EXPECT_NEAR(by_young[k] * 1e10 / plate.frequency(k), 0.5, 1e-6);
}

class Sensitivities : public InFolder {};

TEST_F(Sensitivities, AreATableOfOrthodynModes) {
  write("plate.yaml", kPlate);
  const std::string modes = "modes plate.yaml -n 8 --out out --force --sensitivity ";
  const auto result = orthodyn(modes + "materials.wood.density --sensitivity regions.body.axes.angle");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  for (const char* part : {"materials.wood.density + 1 %", "regions.body.axes.angle + 1 deg", "-0.5000"})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << "\nin: " << result.output;
  EXPECT_NE(read_text(folder_ / "out/sensitivities.csv").find("d frequency / d materials.wood.density"),
            std::string::npos);
}

TEST_F(Sensitivities, AreRefusedForWhatIsNoParameter) {
  write("plate.yaml", kPlate);
  const std::string modes = "modes plate.yaml -n 8 --out out --force --sensitivity ";
  const std::pair<const char*, const char*> wrong[] = {
      {"materials.wood.yung.0", "no key 'yung'; did you mean 'young'?"},
      {"materials.wood.young.3", "'3' is no entry of a list of 3, counted from 0"},
      {"materials.wood.type", "a parameter must be a number, found"},
      {"materials.wood.density.x", "has no entries"},
      {"mesh.size", "a parameter must be a number"},
      {"mesh.cells.0", "derivative with respect to mesh.cells.0"},
      {"materials.wood.young.99999999999999999999", "no entry of a list of 3"}};
  for (const auto& [path, message] : wrong) {
    const auto result = orthodyn(modes + path);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.output.find(message), std::string::npos) << result.output;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  const auto loaded = orthodyn(modes + "materials.wood.density --equilibrium");
  EXPECT_EQ(loaded.exit_code, 2);
  EXPECT_NE(loaded.output.find("about rest only"), std::string::npos) << loaded.output;
}

}  // namespace
}  // namespace orthodyn::sensitivity_test
