// Derivatives of extremes over a run, and of the times of events, against closed forms and differences between runs.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "lib/config/config.h"
#include "tests/simulation/result_reader.h"

namespace orthodyn::extreme_sensitivity_test {
namespace {

using Json = nlohmann::json;

// A bar of one element without lateral contraction, which vibrates along x: the end has the displacement u with
//   u'' + a u' + w^2 u = 0,   w^2 = 2 E / (rho L^2)   (lumped mass),   u(0) = 0,   u'(0) = V.
constexpr double kYoung = 3e4, kDensity = 1000, kDamping = 2, kLength = 0.5, kSpeed = 0.1;
const char* const kBar = R"(
mesh: {type: box, size: [0.5, 0.1, 0.2], cells: [1, 1, 1], elements: hexahedra, order: 1}
materials: {m: {type: isotropic, density: 1000, young: 30 kPa, nu: 0}}
elasticity: {kinematics: linear}
damping: {mass: 2}
mass: lumped
clamps: [{surface: x0}]
initial: {velocity_field: ["0.2*x", "0", "0"]}
time: {end: 0.5}
integrator: {type: cvode_bdf, rtol: 1e-9, max_order: 5}
output:
  frames: 2
  probes: {tip: {at: [0.5, 0, 0], fields: [displacement, velocity, nodal_stress]}}
  extremes: [tip.displacement.x.largest, tip.displacement.x.smallest, tip.velocity.x.largest, tip.nodal_stress.xx.largest]
events:
  - {quantity: tip.displacement.x, crosses: 0, direction: down, name: back}
  - {quantity: tip.velocity.x, crosses: 0, name: turns}
sensitivities: [materials.m.young, materials.m.density, damping.mass]
)";
const char* const kPaths[] = {"materials.m.young", "materials.m.density", "damping.mass"};
constexpr double kValues[] = {kYoung, kDensity, kDamping};

struct Vibration {
  double young, density, damping;
  double omega() const { return std::sqrt(2 * young / density) / kLength; }
  double damped() const { return std::sqrt(omega() * omega() - damping * damping / 4); }
  double u(double t) const { return kSpeed / damped() * std::exp(-damping / 2 * t) * std::sin(damped() * t); }
  double peak(int half_periods) const {
    return (std::atan(2 * damped() / damping) + half_periods * std::numbers::pi) / damped();
  }
  double largest() const { return u(peak(0)); }
  double smallest() const { return u(peak(1)); }
  double stress() const { return young * largest() / kLength; }
  double back() const { return std::numbers::pi / damped(); }
};

// Derivative of a closed form with respect to parameter i, by a difference with a relative error of about 1e-9.
template <class F>
double derivative(int i, F f) {
  const double step = 1e-5 * kValues[i];
  const auto at = [&](double change) {
    Vibration one{kYoung, kDensity, kDamping};
    (i == 0 ? one.young : i == 1 ? one.density : one.damping) += change;
    return f(one);
  };
  return (at(step) - at(-step)) / (2 * step);
}

class ExtremeSensitivity : public InFolder {
 protected:
  Json extremes(const std::string& name, const std::string& scene) const {
    write(name + ".yaml", scene);
    const CommandResult result = orthodyn("run " + name + ".yaml --quiet --force --out " + name);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return Json::parse(read_text(folder_ / name / "run.json")).at("extremes");
  }
  // Cells of a table that may have text.
  std::vector<std::vector<std::string>> cells(const std::string& name, const std::string& table) const {
    std::vector<std::vector<std::string>> all;
    std::istringstream in(read_text(folder_ / name / table));
    for (std::string line; std::getline(in, line);) {
      std::vector<std::string> row{""};
      for (const char c : line) {
        if (c == ',') row.emplace_back();
        else row.back().push_back(c);
      }
      all.push_back(row);
    }
    return all;
  }
};

TEST_F(ExtremeSensitivity, OfAVibrationIsThatOfItsClosedForm) {
  const Json found = extremes("bar", kBar);
  const Vibration exact{kYoung, kDensity, kDamping};
  EXPECT_NEAR(found["tip.displacement.x.largest"]["value"].get<double>(), exact.largest(), 1e-6 * exact.largest());
  EXPECT_NEAR(found["tip.displacement.x.largest"]["time"].get<double>(), exact.peak(0), 1e-5);
  for (int i = 0; i < 3; ++i) {
    const auto expect = [&](const char* quantity, double expected, double size) {
      EXPECT_NEAR(found[quantity]["derivatives"][kPaths[i]].get<double>(), expected, 1e-4 * size / kValues[i])
          << quantity << " " << kPaths[i];
    };
    expect("tip.displacement.x.largest", derivative(i, [](auto& v) { return v.largest(); }), exact.largest());
    expect("tip.displacement.x.smallest", derivative(i, [](auto& v) { return v.smallest(); }), exact.largest());
    expect("tip.nodal_stress.xx.largest", derivative(i, [](auto& v) { return v.stress(); }), exact.stress());
    expect("tip.velocity.x.largest", 0, kSpeed);  // at the start
  }
}

TEST_F(ExtremeSensitivity, AtTheEndOfTheRunIsThatOfTheEnd) {
  Config scene = Config::from_text(kBar, "scene.yaml");
  const double end = 0.05;
  scene.set_yaml("time.end", fmt::format("{}", end));
  scene.set_yaml("events", "[]");
  const Json found = extremes("short", scene.yaml())["tip.displacement.x.largest"];
  const Vibration exact{kYoung, kDensity, kDamping};
  ASSERT_LT(end, exact.peak(0));
  EXPECT_EQ(found["time"], end);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(found["derivatives"][kPaths[i]].get<double>(), derivative(i, [&](auto& v) { return v.u(end); }),
                1e-5 * exact.u(end) / kValues[i]);
}

TEST_F(ExtremeSensitivity, OfTheTimesOfEventsIsThatOfTheirClosedForm) {
  extremes("bar", kBar);
  const auto table = cells("bar", "sensitivities_of_events.csv"), events = cells("bar", "events.csv");
  ASSERT_GE(table.size(), 3U);
  ASSERT_EQ(table.size(), events.size());
  EXPECT_EQ(table[0][2], "d t / d materials.m.young [s / SI unit]");
  EXPECT_EQ(table[1][1], "turns");
  EXPECT_EQ(table[2][1], "back");
  const Vibration exact{kYoung, kDensity, kDamping};
  for (std::size_t row : {1, 2}) {
    EXPECT_EQ(table[row][0], events[row][0]);
    EXPECT_EQ(table[row].back(), "");
    for (int i = 0; i < 3; ++i) {
      const double expected = derivative(i, [&](auto& v) { return row == 1 ? v.peak(0) : v.back(); });
      EXPECT_NEAR(std::stod(table[row][2 + static_cast<std::size_t>(i)]), expected, 1e-4 * exact.back() / kValues[i])
          << row << kPaths[i];
    }
  }
}

// A support whose displacement has an inflection, exactly at the threshold.
TEST_F(ExtremeSensitivity, AnEventAtWhichNothingMovesHasNone) {
  Config scene = Config::from_text(kBar, "scene.yaml");
  scene.set_yaml("clamps", "[]");
  scene.set_yaml("initial", "{}");
  scene.set_yaml("motions", "[{surface: x0, displacement: [\"(t-0.25)^3\", \"0\", \"0\"]}]");
  scene.set_yaml("events",
                 "[{quantity: root.displacement.x, crosses: 0}, {quantity: root.displacement.x, crosses: 1e-3}]");
  scene.set_yaml("output.probes", "{root: {at: [0, 0, 0], fields: [displacement]}}");
  scene.set_yaml("output.extremes", "[root.displacement.x.largest]");
  const Json found = extremes("still", scene.yaml());
  const auto table = cells("still", "sensitivities_of_events.csv");
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(table[1][2], "");
  EXPECT_EQ(table[1].back(), "the quantity does not move at the threshold");
  EXPECT_EQ(table[2].back(), "");
  EXPECT_NEAR(std::stod(table[2][2]), 0, 1e-12);  // prescribed
}

TEST_F(ExtremeSensitivity, TiesAndStoppedRunsAreTold) {
  Config scene = Config::from_text(kBar, "scene.yaml");
  scene.set_yaml("damping", "{mass: 1e-9}");
  scene.set_yaml("time.end", "1");
  scene.set_yaml("events", "[]");
  write("tie.yaml", scene.yaml());
  const CommandResult tie = orthodyn("run tie.yaml --quiet --out tie");
  EXPECT_NE(tie.output.find("tip.displacement.x.largest: is reached at t = "), std::string::npos) << tie.output;
  scene.set_yaml("damping", "{mass: 2}");
  scene.set_yaml("events", "[{quantity: tip.displacement.x, crosses: 2 mm, action: stop}]");
  const Json found = extremes("stopped", scene.yaml())["tip.displacement.x.largest"];
  EXPECT_FALSE(found.contains("derivatives"));
  EXPECT_NE(found["remark"].get<std::string>().find("end of the run, which an event sets"), std::string::npos);
}

TEST_F(ExtremeSensitivity, GoesOnAfterAnInterruption) {
  const Json whole = extremes("whole", kBar)["tip.displacement.x.largest"];
  const Vibration exact{kYoung, kDensity, kDamping};
  for (const double first : {0.5 * exact.peak(0), 1.5 * exact.peak(0)}) {
    write("parts.yaml", kBar + std::string("checkpoint: {frames: 1}\n"));
    ASSERT_EQ(orthodyn(fmt::format("run parts.yaml --quiet --force --out parts --set time.end={}", first)).exit_code,
              0);
    ASSERT_EQ(orthodyn("run parts.yaml --quiet --out parts --resume").exit_code, 0);
    const Json parts =
        Json::parse(read_text(folder_ / "parts" / "run.json")).at("extremes").at("tip.displacement.x.largest");
    EXPECT_NEAR(parts["time"].get<double>(), whole["time"].get<double>(), 1e-5);
    EXPECT_EQ(cells("parts", "sensitivities_of_events.csv").size(),
              cells("whole", "sensitivities_of_events.csv").size());
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(parts["derivatives"][kPaths[i]].get<double>(), whole["derivatives"][kPaths[i]].get<double>(),
                  1e-4 * exact.largest() / kValues[i]);
  }
}

TEST_F(ExtremeSensitivity, AnUnknownExtremeIsRefused) {
  for (const auto& [name, message] : {std::pair{"tip.displacement.x", "must end with .largest or .smallest"},
                                      {"tip.displacement.largest", "choose .x, .y, .z or .magnitude"},
                                      {"tip.displacment.x.largest", "did you mean"},
                                      {"end.displacement.x.largest", "nor of a probe's component"}}) {
    Config scene = Config::from_text(kBar, "scene.yaml");
    scene.set_yaml("output.extremes", fmt::format("[{}]", name));
    write("scene.yaml", scene.yaml());
    const CommandResult result = orthodyn("run scene.yaml --quiet --out refused");
    EXPECT_EQ(result.exit_code, 2) << name << result.output;
    EXPECT_NE(result.output.find(message), std::string::npos) << name << "\n" << result.output;
  }
}

// A damped strip that swings far: differences between runs tend to the derivatives with order two.
const char* const kStrip = R"(
mesh: {type: box, size: [0.3, 0.03, 0.004], cells: [6, 1, 1], elements: hexahedra}
materials: {m: {type: isotropic, density: 450, young: 0.2 GPa, nu: 0.3}}
elasticity: {kinematics: corotational}
damping: {stiffness: 4 ms}
gravity: [0, 0, -9.81]
clamps: [{surface: x0}]
time: {end: 0.4}
integrator: {type: cvode_bdf, rtol: 1e-8}
output:
  frames: 2
  probes:
    tip: {at: [0.3, 0.03, 0.004], fields: [displacement, velocity]}
    root: {at: [0.05, 0, 0.004], fields: [nodal_stress]}
  extremes: [tip.displacement.z.smallest, tip.velocity.z.largest, tip.displacement.magnitude.largest, root.nodal_stress.xx.largest]
events: [{quantity: tip.displacement.z, crosses: -10 mm}]
)";

TEST_F(ExtremeSensitivity, IsTheLimitOfDifferencesBetweenRuns) {
  const struct {
    const char* path;
    double value;
  } parameters[] = {{"materials.m.young", 0.2e9}, {"gravity.2", -9.81}, {"mesh.size.2", 0.004}};
  const Json slopes =
      extremes("slopes", kStrip + std::string("sensitivities: [materials.m.young, gravity.2, mesh.size.2]"));
  const auto event_slopes = cells("slopes", "sensitivities_of_events.csv");
  ASSERT_GE(event_slopes.size(), 2U);
  int checked = 0;
  for (std::size_t p = 0; p < 3; ++p) {
    const auto& [path, value] = parameters[p];
    std::array<std::map<std::string, double>, 2> differences;
    const std::array<double, 2> steps{0.04 * std::abs(value), 0.02 * std::abs(value)};
    for (std::size_t k = 0; k < 2; ++k)
      for (const double side : {-1.0, 1.0}) {
        Config scene = Config::from_text(kStrip, "scene.yaml");
        scene.set_yaml(path, fmt::format("{:.17g}", value + side * steps[k]));
        const Json changed = extremes("changed", scene.yaml());
        for (const auto& [name, extreme] : changed.items())
          differences[k][name] += side * extreme["value"].get<double>() / (2 * steps[k]);
        differences[k]["event"] += side * std::stod(cells("changed", "events.csv")[1][0]) / (2 * steps[k]);
      }
    for (const auto& [name, coarse] : differences[0]) {
      const double slope =
          name == "event" ? std::stod(event_slopes[1][2 + p]) : slopes[name]["derivatives"][path].get<double>();
      const double size = name == "event" ? std::stod(event_slopes[1][0]) / std::abs(value)
                                          : std::abs(slopes[name]["value"].get<double>() / value);
      SCOPED_TRACE(name + " by " + path);
      const double error = std::abs(differences[1][name] - slope);
      EXPECT_LE(error, 5e-3 * size);
      if (error < 1e-4 * size) continue;  // the error of the integrations
      EXPECT_NEAR(std::log2(std::abs(coarse - slope) / error), 2, 0.4);
      ++checked;
    }
  }
  EXPECT_GE(checked, 5);  // of 15
}

}  // namespace
}  // namespace orthodyn::extreme_sensitivity_test
