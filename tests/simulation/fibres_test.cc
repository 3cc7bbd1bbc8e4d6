// Contracting bodies as a user runs them: balance of energy, conservation, kinematics, sensitivities.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "lib/config/config.h"
#include "lib/simulation/preflight/input_checks/input_checks.h"
#include "tests/simulation/result_reader.h"

namespace orthodyn::fibres_run_test {
namespace {

// A muscle that is pulled and contracts against the pull.
std::string muscle(const std::string& active, const std::string& more, const std::string& k1 = "30e3") {
  return "mesh: {type: box, size: [0.1, 0.02, 0.02], cells: [3, 1, 1]}\n"
         "materials:\n  m:\n    {type: isotropic, density: 1060, young: 12e3, nu: 0.4,\n"
         "     fibres: {passive: {type: exponential, k1: " +
         k1 + ", k2: 2}, active: {stress: 50e3" + active +
         "}}}\n"
         "clamps: [{surface: x0}]\n"
         "loads: [{surface: x1, force: [8, 1, 0], factor: {type: smooth_step, end: 0.05}}]\n"
         "time: {end: 0.3}\noutput: {frames: 0, history: {interval: 0.05}, probes: {tip: {at: [0.1, 0, 0]}}}\n" +
         more;
}

const std::string kRise = "activation: {value: 0.8, factor: {type: smooth_step, start: 0.1, end: 0.2}}\n";
const std::string kHill = ", velocity: {type: hill, shortening_velocity: 8}";

class FibreRuns : public InFolder {
 protected:
  std::vector<std::vector<double>> rows(const std::string& name, const std::string& scene,
                                        const std::string& table) const {
    write(name + ".yaml", scene);
    const CommandResult result = orthodyn("run " + name + ".yaml --quiet --force --out " + name);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return read_rows(folder_ / name / table);
  }

  // The largest imbalance of energy, relative to the largest energy or work. Columns: t, kinetic, elastic,
  // gravitational, dissipated, loads, balance.
  double imbalance(const std::string& name, const std::string& scene) const {
    double largest = 0, scale = 0;
    for (const auto& row : rows(name, scene, "energy.csv")) {
      largest = std::max(largest, std::abs(row[6]));
      for (const std::size_t column : {1u, 2u, 4u, 5u}) scale = std::max(scale, std::abs(row[column]));
    }
    return largest / scale;
  }
};

TEST_F(FibreRuns, BalanceTheirEnergyToTheTolerance) {
  for (const std::string& active : {std::string(), kHill}) {
    const auto scene = [&](const char* rtol) {
      return muscle(active, kRise + "damping: {stiffness: 1e-3}\nintegrator: {type: cvode_bdf, rtol: " + rtol + "}\n");
    };
    const double coarse = imbalance("coarse", scene("1e-4")), fine = imbalance("fine", scene("1e-7"));
    EXPECT_LE(fine, 1e-5) << active;
    EXPECT_LE(fine, coarse / 10) << active;
  }
}

TEST_F(FibreRuns, KeepTheirEnergyAtAFixedActivation) {
  Config scene =
      Config::from_text(muscle("", "activation: {value: 0.3}\nintegrator: {type: energy_momentum, step: 5e-4}\n"));
  scene.set_yaml("materials.m.fibres.active.stress", "5e3");
  scene.set_yaml("loads.0.force", "[2, 0.2, 0]");
  EXPECT_LE(imbalance("fixed", scene.yaml()), 1e-10);
}

// The motion of a nearly straight muscle is the same with linear kinematics as long as strains are small.
TEST_F(FibreRuns, LinearKinematicsAgreeForASmallLoad) {
  const auto tip = [&](const std::string& name, const std::string& kinematics) {
    const std::string scene =
        muscle("", kRise + "damping: {stiffness: 1e-2}\nintegrator: {type: cvode_bdf, rtol: 1e-8}\n" + kinematics);
    Config config = Config::from_text(scene);
    config.set_yaml("materials.m.fibres.active.stress", "50");
    config.set_yaml("loads.0.force", "[8e-3, 0, 0]");
    return rows(name, config.yaml(), "probes.csv").back();
  };
  const auto exact = tip("exact", ""), linear = tip("linear", "elasticity: {kinematics: linear}\n"),
             chosen = tip("chosen", "elasticity: {kinematics: auto}\n");
  EXPECT_GT(std::abs(exact[1]), 1e-6);
  for (const auto& other : {linear, chosen}) EXPECT_NEAR(other[1], exact[1], 5e-3 * std::abs(exact[1]));
}

// Forward sensitivities by CVODES against central differences of whole runs.
TEST_F(FibreRuns, HaveSensitivitiesOfTheirConstants) {
  const std::string more = kRise + "damping: {stiffness: 1e-2}\nintegrator: {type: cvode_bdf, rtol: 1e-8}\n";
  const auto tip = [&](const char* k1) { return rows("run", muscle(kHill, more, k1), "probes.csv").back()[1]; };
  const double quotient = (tip("30.3e3") - tip("29.7e3")) / 600;
  const std::string paths = "sensitivities: [materials.m.fibres.passive.k1]\n";
  const auto table = rows("sensitive", muscle(kHill, more + paths), "sensitivities.csv");
  ASSERT_FALSE(table.empty());
  EXPECT_GT(std::abs(quotient), 1e-9);
  EXPECT_NEAR(table.back()[1], quotient, 2e-3 * std::abs(quotient));
}

// The weak passive tension does not make up for the falling active one, the strong one does.
TEST(FibresThatSplitTheBody, AreWarnedOf) {
  const auto warnings = [](const std::string& k1) {
    return scene_warnings(Config::from_text(muscle("", kRise, k1)), true);
  };
  EXPECT_THAT(warnings("1"), testing::Contains(testing::HasSubstr("falls faster")));
  EXPECT_THAT(warnings("30e3"), testing::Not(testing::Contains(testing::HasSubstr("falls faster"))));
}

}  // namespace
}  // namespace orthodyn::fibres_run_test
