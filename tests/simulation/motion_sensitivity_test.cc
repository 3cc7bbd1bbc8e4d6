// `sensitivities:` of a scene as a user meets them: sensitivities.csv against differences between runs.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "lib/config/config.h"
#include "tests/simulation/resume_fixture.h"

namespace orthodyn::motion_sensitivity_test {
namespace {

// A damped strip with oblique grain that swings by a third of its length under its weight and a short pull, whose
// clamped end shakes. It starts with a velocity.
const char* const kStrip = R"(
mesh: {type: box, size: [0.3, 0.03, 0.004], cells: [6, 1, 1], elements: hexahedra}
materials:
  wood: {type: orthotropic, density: 450, young: [0.5 GPa, 0.04 GPa, 0.04 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 0.035 GPa, g23: 0.01 GPa, g13: 0.035 GPa}
regions: {body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 20 deg}}}
elasticity: {kinematics: corotational}
damping: {stiffness: 4 ms}
gravity: [0, 0, -9.81]
motions: [{surface: x0, displacement: [0, 0, 0.01*sin(20*t)]}]
loads: [{surface: x1, force: [0, 0.2, 0], factor: {type: table, points: [[0, 1], [0.05, 1], [0.06, 0]]}}]
initial: {velocity_field: [0, 0, 2*x]}
time: {end: 0.3}
integrator: {type: cvode_bdf, rtol: 1e-8}
output:
  frames: 0
  history: {interval: 0.05}
  reactions: true
  probes:
    tip: {at: [0.3, 0.03, 0.004], fields: [displacement, velocity]}
    root: {at: [0.05, 0, 0.004], fields: [nodal_strain]}
)";

struct Parameter {
  const char *path, *format;
  double value, si;
};
const Parameter kParameters[] = {{"materials.wood.young.0", "{} GPa", 0.5, 1e9},
                                 {"materials.wood.density", "{}", 450, 1},
                                 {"regions.body.axes.angle", "{} deg", 20, std::numbers::pi / 180},
                                 {"damping.stiffness", "{} ms", 4, 1e-3},
                                 {"loads.0.force.1", "{}", 0.2, 1},
                                 {"gravity.2", "{}", -9.81, 1},
                                 {"mesh.size.2", "{}", 0.004, 1}};
constexpr std::size_t kCount = std::size(kParameters);

std::string with(const std::string& scene, const Parameter& parameter, double value) {
  Config config = Config::from_text(scene, "scene.yaml");
  config.set_yaml(parameter.path, fmt::format(fmt::runtime(parameter.format), value));
  return config.yaml();
}

std::string all_paths() {
  std::string text = "sensitivities: [";
  for (const Parameter& parameter : kParameters) text += std::string(parameter.path) + ", ";
  return text + "]\n";
}

class MotionSensitivity : public InFolder {
 protected:
  // Rows of a table of a run.
  std::vector<std::vector<double>> rows(const std::string& name, const std::string& scene,
                                        const std::string& table) const {
    write(name + ".yaml", scene);
    const CommandResult result = orthodyn("run " + name + ".yaml --quiet --force --out " + name);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return read_rows(folder_ / name / table);
  }
};

// Derivatives of the columns of probes.csv against central differences between runs, whose errors shrink with order
// two.
void expect_order_two(const std::vector<std::vector<double>>& slopes, std::size_t column, std::size_t parameter,
                      const std::array<std::vector<std::vector<double>>, 2>& before,
                      const std::array<std::vector<std::vector<double>>, 2>& after, const std::array<double, 2>& steps,
                      double tolerance, int& checked) {
  double size = 0;
  std::array<double, 2> error{};
  for (std::size_t row = 0; row < slopes.size(); ++row) {
    const double slope = slopes[row][1 + column * kCount + parameter];
    size = std::max(size, std::abs(slope));
    for (std::size_t k = 0; k < 2; ++k) {
      const double difference = (after[k][row][1 + column] - before[k][row][1 + column]) / (2 * steps[k]);
      error[k] = std::max(error[k], std::abs(difference - slope));
    }
  }
  SCOPED_TRACE(fmt::format("{}, column {}, size {:.3g}", kParameters[parameter].path, column, size));
  EXPECT_LE(error[1], 1e-2 * size);
  if (error[1] < tolerance * size) return;  // the error of the integrations
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.4);
  ++checked;
}

TEST_F(MotionSensitivity, IsTheLimitOfDifferencesBetweenRuns) {
  const auto slopes = rows("slopes", kStrip + all_paths(), "sensitivities.csv");
  ASSERT_EQ(slopes.size(), 7U);
  int checked = 0;
  for (std::size_t p = 0; p < kCount; ++p) {
    const Parameter& parameter = kParameters[p];
    const std::array<double, 2> shares{0.04, 0.02};
    std::array<std::vector<std::vector<double>>, 2> before, after;
    std::array<double, 2> steps{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double step = shares[k] * std::abs(parameter.value);
      steps[k] = step * parameter.si;
      before[k] = rows("before", with(kStrip, parameter, parameter.value - step), "probes.csv");
      after[k] = rows("after", with(kStrip, parameter, parameter.value + step), "probes.csv");
    }
    // Displacement and velocity of the tip, strains 11 and 12 at the root.
    for (std::size_t column : {0, 1, 2, 5, 6, 9})
      expect_order_two(slopes, column, p, before, after, steps, 1e-3, checked);
  }
  EXPECT_GE(checked, 10);  // of 42
}

// Largest difference of each column between two tables, relative to the largest value of the column.
std::vector<double> differences(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  EXPECT_EQ(a.size(), b.size());
  std::vector<double> out;
  for (std::size_t column = 1; column < a.at(0).size(); ++column) {
    double size = 0, error = 0;
    for (std::size_t row = 0; row < std::min(a.size(), b.size()); ++row) {
      size = std::max(size, std::abs(a[row][column]));
      error = std::max(error, std::abs(a[row][column] - b[row][column]));
    }
    out.push_back(size > 0 ? error / size : 0);
  }
  return out;
}

// CVODES and IDAS, staggered and simultaneous, find the same derivatives.
TEST_F(MotionSensitivity, DoesNotDependOnTheLibraryAndTheCorrector) {
  Config scene = Config::from_text(kStrip + all_paths(), "scene.yaml");
  scene.set_yaml("time.end", "0.1");
  const auto expected = rows("cvode_bdf", scene.yaml(), "sensitivities.csv");
  const auto expect_same = [&](const std::string& name) {
    const auto found = differences(expected, rows(name, scene.yaml(), "sensitivities.csv"));
    ASSERT_GT(found.size(), 50U);
    for (std::size_t column = 0; column < found.size(); ++column) EXPECT_LE(found[column], 0.01) << name << column;
  };
  scene.set_yaml("integrator.sensitivity_corrector", "simultaneous");
  expect_same("simultaneous");
  scene.set_yaml("integrator", "{type: ida_bdf, rtol: 1e-8}");
  expect_same("ida_bdf");
}

// Without damping by the stiffness, K s comes from the tangent of each state. With very little of it, it is the
// difference of two forces. Both agree in a body that moves by a centimetre.
TEST_F(MotionSensitivity, ByTheTangentIsThatByDifferencesOfForces) {
  Config scene = Config::from_text(kStrip, "scene.yaml");
  scene.set_yaml("sensitivities", "[materials.wood.young.0, gravity.2, mesh.size.2]");
  scene.set_yaml("damping", "{mass: 5}");
  scene.set_yaml("time.end", "0.006");
  scene.set_yaml("output.history.interval", "0.002");
  scene.set_yaml("integrator.rtol", "1e-4");
  const auto by_tangent = rows("tangent", scene.yaml(), "sensitivities.csv");
  scene.set_yaml("damping", "{mass: 5, stiffness: 1e-15}");
  const auto by_forces = rows("forces", scene.yaml(), "sensitivities.csv");
  const auto found = differences(by_tangent, by_forces);
  for (const std::size_t displacement : {0, 1, 2})
    for (std::size_t p = 0; p < 3; ++p) EXPECT_LE(found[3 * displacement + p], 0.02) << displacement << " " << p;
}

// A start from equilibrium is itself a function of the parameters. Without a change of the loads the body stays there.
TEST_F(MotionSensitivity, OfARestingBodyStaysThatOfItsEquilibrium) {
  const std::string bar = R"(
mesh: {type: box, size: [0.5, 0.1, 0.2], cells: [2, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1 GPa, nu: 0}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [100, 0, 0]}]
output: {probes: {end: {at: [0.5, 0, 0]}}}
sensitivities: [materials.m.young, mesh.size.0, loads.0.force.0]
)";
  const double u = 100 * 0.5 / (1e9 * 0.02);
  const double expected[] = {-u / 1e9, u / 0.5, u / 100};
  const auto moving =
      rows("moving", bar + "start: equilibrium\ntime: {end: 0.01}\nintegrator: {type: cvode_bdf, rtol: 1e-6}\n",
           "sensitivities.csv");
  const auto resting = rows("resting", bar + "analysis: static\n", "sensitivities.csv");
  ASSERT_EQ(moving.size(), 51U);
  ASSERT_EQ(resting.size(), 1U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(resting[0][1 + i], expected[i], 1e-7 * std::abs(expected[i]));
    for (const auto& row : moving) EXPECT_NEAR(row[1 + i], expected[i], 1e-4 * std::abs(expected[i])) << row[0];
  }
}

TEST_F(MotionSensitivity, GoesOnAfterAnInterruption) {
  const std::string scene = kStrip + all_paths() + "checkpoint: {frames: 1}\n";
  const auto whole = rows("whole", kStrip + all_paths(), "sensitivities.csv");
  write("parts.yaml", scene);
  ASSERT_EQ(orthodyn("run parts.yaml --quiet --out parts --set time.end=0.2").exit_code, 0);
  ASSERT_EQ(orthodyn("run parts.yaml --quiet --out parts --resume").exit_code, 0);
  const auto parts = read_rows(folder_ / "parts" / "sensitivities.csv");
  const auto found = differences(whole, parts);
  for (std::size_t column = 0; column < found.size(); ++column) EXPECT_LE(found[column], 5e-3) << column;
}

TEST_F(MotionSensitivity, RefusesWhatItCannotCompute) {
  const struct {
    const char *change, *value, *message;
  } cases[] = {
      {"sensitivities", "[materials.wood.youngs.0]", "no key 'youngs'"},
      {"sensitivities", "[integrator.rtol]", "is no number of the model"},
      {"sensitivities", "[loads.0.factor.points.1.0]", "changes a time at which a load has a kink"},
      {"sensitivities", "[gravity.2, gravity.2]", "is given twice"},
      {"integrator", "{type: newmark}", "set integrator.type to cvode_bdf, ida_bdf"},
      {"terms", "[{type: ground_contact, point: [0, 0, -1], stiffness: 1e8}]", "contact"},
  };
  for (const auto& c : cases) {
    Config scene = Config::from_text(kStrip + all_paths(), "scene.yaml");
    scene.set_yaml(c.change, c.value);
    write("scene.yaml", scene.yaml());
    const CommandResult result = orthodyn("run scene.yaml --quiet --out refused");
    EXPECT_EQ(result.exit_code, 2) << c.value << result.output;
    EXPECT_NE(result.output.find(c.message), std::string::npos) << c.value << "\n" << result.output;
    EXPECT_FALSE(fs::exists(folder_ / "refused" / "run.json")) << c.value;
  }
}

}  // namespace
}  // namespace orthodyn::motion_sensitivity_test
