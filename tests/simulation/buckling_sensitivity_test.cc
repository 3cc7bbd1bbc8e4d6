// Derivatives of critical load factors with respect to numbers of a scene, against closed forms and repeated analyses.
#include "lib/simulation/sensitivity/buckling_sensitivity.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/simulation/run/setup.h"
#include "lib/simulation/sensitivity/changed_models.h"
#include "lib/simulation/statics/static_problem.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::buckling_sensitivity_test {
namespace {

struct Analysis {
  explicit Analysis(const Config& scene, int count = 3)
      : setup(set_up(scene)),
        unloaded(unloaded_shape(setup.scene, setup.built)),
        found(buckling_modes(*setup.built.model, unloaded, setup.scene.time.end, count)) {}
  explicit Analysis(const std::string& scene, int count = 3)
      : Analysis(Config::from_text(scene, "scene.yaml"), count) {}

  std::vector<double> derivatives(const std::string& path) const {
    const auto parameters = model_parameters(setup.config, {path}, {});
    return buckling_sensitivities(setup.config, *setup.built.model, unloaded, setup.scene.time.end, found, parameters)
        .at(0)
        .derivatives;
  }
  double factor(std::size_t k) const { return found.modes.at(k).load_factor; }

  Setup setup;
  Vector unloaded;
  BucklingModes found;
};

// Rounding errors relative to the derivative: machine epsilon over the prebuckling strain 1e-4, times the square of
// length over thickness of an element, over the step of the differences.
double round_off(double length, double thickness) {
  return 2.2e-16 / 1e-4 * (length / thickness) * (length / thickness) / 0.003;
}

// lambda = pi^2/4 E b h^3 / (12 L^2) / F for bending in z; the second plane has b and h exchanged.
const std::string kColumn = R"(
analysis: buckling
mesh: {type: box, size: [1, 0.05, 0.02], cells: [20, 2, 2]}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [-10, 0, 0]}]
)";

TEST(BucklingSensitivity, OfEulersColumnHasTheExponentsOfItsClosedForm) {
  const Analysis column(kColumn, 1);
  const double lambda = column.factor(0), exact = round_off(1, 0.01);
  const struct {
    const char* path;
    double value, exponent, tolerance;
  } cases[] = {{"materials.m.young", 1e9, 1, exact},
               {"loads.0.force.0", -10, -1, exact},
               {"mesh.size.0", 1, -2, 0.01},  // of a slender beam, as are the following
               {"mesh.size.1", 0.05, 1, 0.01},
               {"mesh.size.2", 0.02, 3, 0.01}};
  for (const auto& c : cases)
    EXPECT_NEAR(column.derivatives(c.path).at(0) * c.value / lambda, c.exponent, c.tolerance) << c.path;
}

// A plate with oblique grain, pressed and sheared in its plane. Its prebuckling stresses depend on all constants.
const char* const kPlate = R"(
analysis: buckling
mesh: {type: box, size: [0.4, 0.3, 0.012], cells: [6, 5, 1], elements: hexahedra}
materials:
  wood: {type: orthotropic, density: 450, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 0.7e9, g23: 4e7, g13: 6e8}
regions: {body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 25 deg}}}
clamps: [{surface: x0}, {surface: y0, components: [z]}]
loads: [{surface: x1, force: [-1000, 200, 0]}]
)";

// Central differences of repeated analyses converge to the derivative with order two.
void expect_order_two(const std::string& text, const std::string& path, const char* format, double value, double si,
                      double share) {
  const auto exact = Analysis(text).derivatives(path);
  const auto error = [&](double h, std::size_t mode) {
    const auto factor = [&](double at) {
      Config scene = Config::from_text(text, "scene.yaml");
      scene.set_yaml(path, fmt::format(fmt::runtime(format), at));
      return Analysis(scene).factor(mode);
    };
    return (factor(value + h) - factor(value - h)) / (2 * h * si) - exact[mode];
  };
  for (const std::size_t mode : {0, 1, 2}) {
    const double h = share * value, coarse = error(h, mode), fine = error(h / 2, mode);
    if (std::abs(coarse) < 1e-5 * std::abs(exact[mode])) continue;  // hardly more than rounding errors
    EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 2, 0.3)
        << path << ", mode " << mode << ": " << exact[mode] << ", errors " << coarse << ", " << fine;
  }
}

TEST(BucklingSensitivity, IsTheLimitOfDifferences) {
  const double degree = std::numbers::pi / 180;
  expect_order_two(kPlate, "regions.body.axes.angle", "{} deg", 25, degree, 0.08);
  expect_order_two(kPlate, "materials.wood.g12", "{}", 0.7e9, 1, 0.08);
  expect_order_two(kPlate, "materials.wood.young.0", "{} GPa", 10.8, 1e9, 0.08);
  expect_order_two(kPlate, "materials.wood.nu12", "{}", 0.37, 1, 0.16);
  expect_order_two(kPlate, "mesh.size.2", "{}", 0.012, 1, 0.08);
  expect_order_two(kPlate, "mesh.size.0", "{}", 0.4, 1, 0.08);
  expect_order_two(kPlate, "loads.0.force.1", "{}", 200, 1, 0.16);
}

// A stretched spring deforms the strip before the loads act. The pressure follows the strip, and has a stiffness.
const char* const kSpringAndPressure = R"(
analysis: buckling
mesh: {type: box, size: [0.5, 0.05, 0.01], cells: [8, 1, 1], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
terms:
  - {type: spring, surface: x1, stiffness: 2000, anchor: [0.9, 0.025, 0.005], rest_length: 0.38}
  - {type: pressure, surface: x1, pressure: 1000}
)";

TEST(BucklingSensitivity, IncludesTheShapeWithoutLoadsAndTheStiffnessOfLoads) {
  expect_order_two(kSpringAndPressure, "terms.0.rest_length", "{}", 0.38, 1, 0.02);
  expect_order_two(kSpringAndPressure, "terms.0.stiffness", "{}", 2000, 1, 0.08);
  expect_order_two(kSpringAndPressure, "terms.1.pressure", "{}", 1000, 1, 0.16);
  expect_order_two(kSpringAndPressure, "materials.m.young", "{}", 1e9, 1, 0.08);
}

// A square column buckles alike in two planes. If it becomes higher, its factor grows as the cube of the height in one
// plane, and as the height in the other.
TEST(BucklingSensitivity, OfEqualFactorsIsThatOfTheirBranches) {
  const std::string column = R"(
analysis: buckling
mesh: {type: box, size: [1, 0.05, 0.05], cells: [10, 2, 2], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [-100, 0, 0]}]
)";
  const Analysis two(column, 2), one(column, 1);
  const double lambda = two.factor(0);
  ASSERT_NEAR(two.factor(1) / lambda, 1, 1e-8);
  const auto by_height = two.derivatives("mesh.size.2");
  EXPECT_NEAR(by_height[0], lambda / 0.05, 0.05 * lambda / 0.05);
  EXPECT_NEAR(by_height[1], 3 * lambda / 0.05, 0.05 * lambda / 0.05);
  EXPECT_NEAR(one.derivatives("mesh.size.2").at(0), by_height[0], 1e-6 * lambda / 0.05);
}

// A plate 400 times longer than thick.
TEST(BucklingSensitivity, IsAccurateForThinPlates) {
  const Analysis plate(R"(
analysis: buckling
mesh: {type: box, size: [0.4, 0.3, 0.001], cells: [12, 9, 1]}
materials: {m: {type: isotropic, density: 450, young: 1e10, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [-1, 0, 0]}]
)",
                       2);
  const auto by_young = plate.derivatives("materials.m.young"), by_load = plate.derivatives("loads.0.force.0");
  for (const std::size_t k : {0, 1}) {
    EXPECT_NEAR(by_young[k] * 1e10 / plate.factor(k), 1, round_off(0.4, 0.001)) << k;
    EXPECT_NEAR(by_load[k] / plate.factor(k), 1, round_off(0.4, 0.001)) << k;
  }
}

class BucklingSensitivities : public InFolder {};

TEST_F(BucklingSensitivities, AreATableOfTheRun) {
  write("column.yaml", kColumn + "buckling: {count: 2}\nsensitivities: [materials.m.young, loads.0.force.0]\n");
  const auto result = orthodyn("run column.yaml --out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("out/sensitivities.csv"), std::string::npos) << result.output;
  EXPECT_NE(read_text(folder_ / "out/sensitivities.csv").find("d load_factor / d loads.0.force.0 [1 / SI unit]"),
            std::string::npos);
  const auto rows = read_rows(folder_ / "out/sensitivities.csv");
  ASSERT_EQ(rows.size(), 2u);
  for (const auto& row : rows) {
    EXPECT_NEAR(row[2], row[1] / 1e9, 1e-6 * row[1] / 1e9);
    EXPECT_NEAR(row[3], row[1] / 10, 1e-6 * row[1] / 10);
  }
}

TEST_F(BucklingSensitivities, AreRefusedForContactAndForWhatIsNoParameter) {
  const struct {
    const char *more, *says;
  } cases[] = {
      {"sensitivities: [materials.m.yung]", "did you mean 'young'?"},
      {"sensitivities: [buckling.count]", "is no number of the model"},
      {"sensitivities: [materials.m.young]\nterms: [{type: ground_contact, stiffness: 1000, point: [0, 0, -1]}]",
       "kinks"}};
  for (const auto& [more, says] : cases) {
    write("column.yaml", kColumn + std::string(more) + "\n");
    const auto result = orthodyn("run column.yaml --out out");
    EXPECT_EQ(result.exit_code, 2) << more << "\n" << result.output;
    EXPECT_NE(result.output.find(says), std::string::npos) << more << "\n" << result.output;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << more;
  }
}

}  // namespace
}  // namespace orthodyn::buckling_sensitivity_test
