// Strain gauges: closed forms of homogeneous deformations, and derivatives against closed forms and differences between
// runs.
#include "lib/scene/gauge.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "lib/scene/quantity.h"
#include "lib/simulation/run/setup.h"
#include "lib/simulation/sensitivity/equilibrium_sensitivity.h"
#include "lib/simulation/sensitivity/gradient.h"
#include "lib/simulation/statics/static_problem.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::gauge_test {
namespace {

using testing::HasSubstr;

// The message of a refusal; "" if the scene is accepted.
std::string refusal(const std::string& scene) {
  try {
    set_up(Config::from_text(scene, "scene.yaml"));
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

// A free body with a gauge whose points are no nodes.
std::string body(const char* elements) {
  return fmt::format(R"(
mesh: {{type: box, size: [0.5, 0.1, 0.2], cells: [3, 1, 2], elements: {}}}
materials: {{m: {{type: isotropic, density: 1000, young: 1 GPa, nu: 0.3}}}}
time: {{end: 1}}
output: {{gauges: {{g: {{from: [0.11, 0.03, 0.04], to: [0.41, 0.07, 0.17]}}}}}}
)",
                     elements);
}
const Vec3 kSpan(0.3, 0.04, 0.13);

// The values of the gauge for the displacement x -> (F - I) x.
std::pair<double, double> after(const char* elements, const Mat3& displacement_gradient) {
  const Setup setup = set_up(Config::from_text(body(elements), "scene.yaml"));
  const FemModel& model = *setup.built.model;
  State state = setup.built.initial;
  for (int node = 0; node < static_cast<int>(model.parts().mesh.nodes.size()); ++node) {
    const Vec3 u = displacement_gradient * model.parts().mesh.node(node);
    for (std::size_t axis = 0; axis < 3; ++axis)
      state.q[model.parts().dofs->node(node)[axis]] = u[static_cast<Eigen::Index>(axis)];
  }
  const ObservedState observed(model, state);
  const auto value = [&](const char* name) {
    return find_quantity(name, setup.scene, model, {}).values(observed).at(0);
  };
  return {value("g.length"), value("g.strain")};
}

class GaugeOn : public testing::TestWithParam<const char*> {};

TEST_P(GaugeOn, MeasuresNoStrainInARigidRotation) {
  const Mat3 R = Eigen::AngleAxisd(1.9, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const auto [length, strain] = after(GetParam(), R - Mat3::Identity());
  EXPECT_NEAR(length, kSpan.norm(), 1e-14);
  EXPECT_NEAR(strain, 0, 1e-14);
}

TEST_P(GaugeOn, MeasuresTheStrainOfAHomogeneousDeformation) {
  Mat3 F;
  F << 1.2, 0.3, 0, -0.1, 0.9, 0.05, 0, 0.2, 1.1;
  const auto [length, strain] = after(GetParam(), F - Mat3::Identity());
  EXPECT_NEAR(length, (F * kSpan).norm(), 1e-14);
  EXPECT_NEAR(strain, (F * kSpan).norm() / kSpan.norm() - 1, 1e-14);
}

// Subtracting the lengths would lose the strain.
TEST_P(GaugeOn, KeepsTheDigitsOfSmallStrains) {
  const double small = 1e-13;
  EXPECT_NEAR(after(GetParam(), small * Mat3::Identity()).second, small, 1e-10 * small);
}

INSTANTIATE_TEST_SUITE_P(Elements, GaugeOn, testing::Values("tetrahedra", "hexahedra", "wedges"));

// A bar under tension has the strain F / (E A) along x, and none across. The second gauge is oblique.
std::string bar(const std::string& more = "", const char* analysis = "analysis: static") {
  return std::string(analysis) + R"(
mesh: {type: box, size: [0.5, 0.1, 0.2], cells: [3, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1 GPa, nu: 0}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
output:
  gauges:
    along: {from: [0.1, 0.05, 0.2], to: [0.37, 0.05, 0.2]}
    oblique: {from: [0.1, 0.05, 0.05], to: [0.2, 0.05, 0.15]}
)" + more;
}
const char* const kPull = "loads: [{surface: x1, force: [1e6, 0, 0]}]\n";
constexpr double kStrain = 1e6 / (1e9 * 0.02);

struct Equilibrium {
  explicit Equilibrium(const std::string& scene)
      : setup(set_up(Config::from_text(scene, "scene.yaml"))), problem(static_problem(setup.scene, setup.built)) {
    while (!problem.stepper->done()) problem.stepper->step();
    const State at = problem.stepper->state();
    state = {problem.path->times().end, at.q, at.v};
  }
  double value(const std::string& quantity) const {
    return find_quantity(quantity, setup.scene, *setup.built.model, {})
        .values(ObservedState(*setup.built.model, state))
        .at(0);
  }
  double derivative(const std::string& path, const std::string& quantity) const {
    return EquilibriumSensitivity(setup.config, setup.scene, *setup.built.model, *problem.path, state)
        .derivatives(SceneParameter(setup.config, path),
                     named_quantities({quantity}, setup.scene, *setup.built.model))[0];
  }

  Setup setup;
  StaticProblem problem;
  State state;
};

TEST(Gauge, OfABarHasTheValuesAndDerivativesOfItsClosedForms) {
  const Equilibrium pulled(bar(kPull));
  const double e = kStrain, stretched = std::hypot(1 + e, 1.0) / std::sqrt(2);
  const double of_oblique = (1 + e) / (2 * stretched);  // d strain / de
  EXPECT_NEAR(pulled.value("along.strain"), e, 1e-9 * e);
  EXPECT_NEAR(pulled.value("along.length"), 0.27 * (1 + e), 1e-10);
  EXPECT_NEAR(pulled.value("oblique.strain"), stretched - 1, 1e-9 * e);
  const struct {
    const char *path, *quantity;
    double expected;
  } cases[] = {{"materials.m.young", "along.strain", -e / 1e9},
               {"loads.0.force.0", "along.length", 0.27 * e / 1e6},
               {"mesh.size.1", "along.strain", -e / 0.1},
               {"materials.m.young", "oblique.strain", -of_oblique * e / 1e9},
               {"mesh.size.1", "oblique.length", -std::sqrt(0.02) * of_oblique * e / 0.1}};
  for (const auto& c : cases)
    EXPECT_NEAR(pulled.derivative(c.path, c.quantity), c.expected, 1e-7 * std::abs(c.expected))
        << c.path << " " << c.quantity;
  // The strain is homogeneous, and the points stay at their places in a longer bar.
  EXPECT_NEAR(pulled.derivative("mesh.size.0", "along.length"), 0, 1e-8);
  EXPECT_NEAR(pulled.derivative("mesh.size.0", "oblique.strain"), 0, 1e-8 * e);
}

// A strip with oblique grain that bends far, with a gauge along its upper side and one across. Points are so far inside
// of elements that they stay there in the changed scenes.
const char* const kBent = R"(
analysis: static
mesh: {type: box, size: [0.2, 0.03, 0.004], cells: [8, 1, 1], elements: hexahedra}
materials:
  wood: {type: orthotropic, density: 450, young: [10.8 GPa, 0.84 GPa, 0.46 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 0.7e9, g23: 4e7, g13: 6e8}
regions: {body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 20 deg},
                 stiffness_factors: {grid: [2, 1, 1], values: [1.2, 0.8]}}}
elasticity: {kinematics: corotational}
clamps: [{surface: x0}]
statics: {solver: {type: kinsol, rtol: 1e-12}}
loads: [{surface: x1, force: [0, 0.3, -3]}]
output:
  gauges:
    top: {from: [0.013, 0.01, 0.0038], to: [0.061, 0.022, 0.0038]}
    across: {from: [0.056, 0.004, 0.0002], to: [0.163, 0.02, 0.0038]}
)";

const struct {
  const char *path, *format;
  double value, si;
} kNumbers[] = {{"regions.body.axes.angle", "{} deg", 20, std::numbers::pi / 180},
                {"materials.wood.young.0", "{} GPa", 10.8, 1e9},
                {"regions.body.stiffness_factors.values.1", "{}", 0.8, 1},
                {"mesh.size.0", "{}", 0.2, 1},
                {"mesh.size.2", "{}", 0.004, 1}};

// Differences between runs converge to the derivatives with order two; gradients are the same derivatives.
TEST(Gauge, HasDerivativesThatAreLimitsOfDifferences) {
  const Equilibrium bent{std::string(kBent)};
  int checked = 0;
  for (const auto& p : kNumbers) {
    const auto at = [&](double value) {
      Config scene = Config::from_text(kBent, "scene.yaml");
      scene.set_yaml(p.path, fmt::format(fmt::runtime(p.format), value));
      return Equilibrium(scene.yaml());
    };
    const double steps[] = {0.02 * p.value, 0.01 * p.value};
    const Equilibrium before[] = {at(p.value - steps[0]), at(p.value - steps[1])};
    const Equilibrium ahead[] = {at(p.value + steps[0]), at(p.value + steps[1])};
    for (const char* quantity : {"top.strain", "top.length", "across.strain"}) {
      const double exact = bent.derivative(p.path, quantity);
      const auto error = [&](int i) {
        return (ahead[i].value(quantity) - before[i].value(quantity)) / (2 * steps[i] * p.si) - exact;
      };
      const double scale = std::max(std::abs(exact), std::abs(bent.value("top.strain") / (p.value * p.si)));
      EXPECT_NEAR(error(1), 0, 0.02 * scale) << p.path << " " << quantity;
      const Gradient found = gradient(Config::from_text(kBent, "scene.yaml").resolving(), {quantity, {}, {p.path}});
      EXPECT_NEAR(found.derivatives[0], exact, 1e-5 * scale) << p.path << " " << quantity;
      EXPECT_NEAR(found.value, bent.value(quantity), 1e-8 * std::abs(found.value)) << quantity;
      if (std::abs(error(0)) < 1e-5 * scale) continue;  // rounding errors
      EXPECT_NEAR(std::log2(std::abs(error(0) / error(1))), 2, 0.3) << p.path << " " << quantity;
      ++checked;
    }
  }
  EXPECT_GE(checked, 9);  // of 15
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream stream(line);
  for (std::string entry; std::getline(stream, entry, ',');) out.push_back(entry);
  return out;
}

class GaugeOfARun : public InFolder {
 protected:
  // The last value of the column whose heading starts with `name`.
  double last(const std::string& scene, const std::string& table, const std::string& name) const {
    write("scene.yaml", scene);
    const CommandResult result = orthodyn("run scene.yaml --quiet --force --out out");
    EXPECT_EQ(result.exit_code, 0) << result.output;
    std::istringstream stream(read_text(folder_ / "out" / table));
    std::string header, row;
    std::getline(stream, header);
    for (std::string line; std::getline(stream, line);) row = line;
    const auto names = split(header);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i].starts_with(name)) return std::stod(split(row)[i]);
    ADD_FAILURE() << "no column " << name << " in " << header;
    return 0;
  }
};

TEST_F(GaugeOfARun, HasColumnsWithUnitsAndMeetsExpectations) {
  const std::string scene = bar(
      std::string(kPull) + "expect: [{quantity: along.strain, value: 0.05, relative: 1e-7, source: s, reason: r}]\n");
  EXPECT_NEAR(last(scene, "probes.csv", "along.length [m]"), 0.27 * 1.05, 1e-9);
  EXPECT_NEAR(last(scene, "probes.csv", "along.strain [1]"), 0.05, 1e-9);
  const CommandResult verified = orthodyn("verify scene.yaml");
  EXPECT_EQ(verified.exit_code, 0) << verified.output;
}

// A damped strip shakes on a moving support, on which one point of the gauge lies.
const char* const kShaken = R"(
mesh: {type: box, size: [0.3, 0.03, 0.008], cells: [6, 1, 1], elements: hexahedra}
materials:
  wood: {type: orthotropic, density: 450, young: [0.5 GPa, 0.04 GPa, 0.04 GPa], nu12: 0.37, nu23: 0.47, nu13: 0.4,
         g12: 0.035 GPa, g23: 0.01 GPa, g13: 0.035 GPa}
regions: {body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: 20 deg}}}
elasticity: {kinematics: linear}
damping: {stiffness: 4 ms}
gravity: [0, 0, -9.81]
motions: [{surface: x0, displacement: [0, 0, 0.01]}]
time: {end: 0.1}
integrator: {type: cvode_bdf, rtol: 1e-9}
output:
  frames: 1
  gauges: {g: {from: [0, 0.01, 0.006], to: [0.07, 0.02, 0.006]}}
)";

TEST_F(GaugeOfARun, HasTheDerivativesOfAMotion) {
  const struct {
    const char* path;
    double value;
  } numbers[] = {{"materials.wood.young.0", 5e8}, {"mesh.size.2", 0.008}, {"motions.0.displacement.2", 0.01}};
  std::string with = std::string(kShaken) + "sensitivities: [";
  for (const auto& p : numbers) with += std::string(p.path) + ", ";
  for (const auto& p : numbers)
    for (const char* quantity : {"g.length", "g.strain"}) {
      const double found = last(with + "]\n", "sensitivities.csv", fmt::format("d {} / d {} ", quantity, p.path));
      const auto at = [&](double value) {
        Config scene = Config::from_text(kShaken, "scene.yaml");
        scene.set_yaml(p.path, fmt::format("{}", value));
        return last(scene.yaml(), "probes.csv", quantity);
      };
      const double h = 0.01 * p.value, expected = (at(p.value + h) - at(p.value - h)) / (2 * h);
      EXPECT_NEAR(found, expected, 2e-3 * std::abs(expected)) << p.path << " " << quantity;
      const Gradient adjoint = gradient(Config::from_text(kShaken, "scene.yaml").resolving(), {quantity, {}, {p.path}});
      EXPECT_NEAR(adjoint.derivatives[0], found, 2e-3 * std::abs(found)) << p.path << " " << quantity;
    }
}

// The forces at both ends nearly cancel; the tolerance of the adjoint equations must allow for that.
TEST(Gauge, HasAnAccurateGradientAtTheDefaultTolerance) {
  std::string scene = kShaken;
  scene.replace(scene.find("rtol: 1e-9"), 10, "rtol: 1e-4");
  scene.replace(scene.find("motions:"), std::string("motions: [{surface: x0, displacement: [0, 0, 0.01]}]").size(),
                "clamps: [{surface: x0}]");
  const auto derivative = [&](const std::string& text) {
    return gradient(Config::from_text(text, "scene.yaml").resolving(), {"g.strain", {}, {"materials.wood.young.0"}})
        .derivatives[0];
  };
  std::string tight = scene;
  tight.replace(tight.find("rtol: 1e-4"), 10, "rtol: 1e-9");
  const double exact = derivative(tight);
  EXPECT_NEAR(derivative(scene), exact, 0.03 * std::abs(exact));
}

// Far below the first resonance (500 Hz) the amplitude is the static strain.
TEST_F(GaugeOfARun, HasAnAmplitude) {
  const std::string scene =
      bar("loads: [{surface: x1, force: [1e6, 0, 0], factor: {type: harmonic}}]\nexpect:\n"
          "  - {response: amplitude, frequency: 1 Hz, quantity: along.strain, value: 0.05, relative: 1e-4, source: s, "
          "reason: r}\n"
          "  - {response: amplitude, frequency: 1 Hz, quantity: along.length, value: 13.5 mm, relative: 1e-4, source: "
          "s, reason: r}\n"
          "harmonic: {frequencies: [1 Hz, 100 Hz], damping_ratio: 0.01}\n",
          "analysis: harmonic");
  write("scene.yaml", scene);
  const CommandResult verified = orthodyn("verify scene.yaml");
  EXPECT_EQ(verified.exit_code, 0) << verified.output;
}

TEST(Gauge, IsRefusedWithTheReason) {
  const auto with = [](const std::string& gauges) {
    std::string scene = bar(kPull);
    const auto begin = scene.find("  gauges:"), end = scene.find("loads:");
    return scene.replace(begin, end - begin, gauges + "\n");
  };
  EXPECT_EQ(refusal(bar(kPull)), "");
  EXPECT_THAT(refusal(with("  gauges: {g: {from: [0, 0, 0], to: [0, 0, 0]}}")),
              HasSubstr("from and to are the same point of the body"));
  EXPECT_THAT(refusal(with("  gauges: {g: {from: [0, 0, 0], to: [50, 0, 0]}}")),
              HasSubstr("to: the point [50, 0, 0] m is 49.5 m away from the body"));
  EXPECT_THAT(refusal(with("  gauges: {g: {from: [0, 0, 0]}}")), HasSubstr("'to'"));
  EXPECT_THAT(refusal(with("  gauges: {\"a,b\": {from: [0, 0, 0], to: [0.1, 0, 0]}}")), HasSubstr("commas"));
  EXPECT_THAT(refusal(with("  probes: {g: {at: [0, 0, 0]}}\n  gauges: {g: {from: [0, 0, 0], to: [0.1, 0, 0]}}")),
              HasSubstr("a probe has the same name"));
  EXPECT_THAT(refusal(bar(std::string(kPull) +
                          "expect: [{quantity: along.stain, value: 1, relative: 1, source: s, reason: r}]\n")),
              HasSubstr("did you mean 'along.strain'"));
  EXPECT_THAT(
      refusal(bar(std::string(kPull) + "expect: [{quantity: along, value: 1, relative: 1, source: s, reason: r}]\n")),
      HasSubstr("choose .length, .strain"));
  EXPECT_THAT(refusal(bar(std::string(kPull) +
                          "expect: [{quantity: along.strain, value: 1 mm, relative: 1, source: s, reason: r}]\n")),
              HasSubstr("expected a plain number, found the unit 'mm'"));
  EXPECT_THAT(refusal(bar(kPull, "analysis: buckling")), HasSubstr("has no effect in a buckling analysis"));
}

}  // namespace
}  // namespace orthodyn::gauge_test
