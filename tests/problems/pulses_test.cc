// Every integrator resolves a load or support pulse of a thousandth of the run after a long rest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/problems/running.h"

namespace orthodyn::pulses_test {
namespace {

const char* kPulse = "exp(-((t - 0.6) / 0.5e-3)^2)";

std::string scene_with(const std::string& integrator, const std::string& acting) {
  return fmt::format(R"(
mesh: {{type: box, size: [0.2, 0.1, 0.1], cells: [1, 1, 1], order: 1}}
materials: {{m: {{type: isotropic, density: 1000, young: 1e6, nu: 0.3}}}}
damping: {{stiffness: 1e-3}}
elasticity: {{kinematics: linear}}
time: {{end: 1}}
integrator: {}
{}
)",
                     integrator, acting);
}

class Pulse : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(OfIntegrators, Pulse,
                         testing::Values("auto", "arkode_dirk", "arkode_erk", "backward_euler", "bathe", "cvode_adams",
                                         "cvode_bdf", "energy_momentum", "exponential_rosenbrock", "generalized_alpha",
                                         "hht_alpha", "ida_bdf", "newmark", "rosenbrock", "sdirk",
                                         "semi_implicit_euler", "tr_bdf2", "modal"),
                         [](const auto& tested) { return tested.param; });

std::string settings(const std::string& integrator) {
  return fmt::format("{{type: {}, rtol: 1e-4{}}}", integrator, integrator == "modal" ? ", modes: 24" : "");
}

// A free body receives the whole impulse of the load.
TEST_P(Pulse, OfALoadIsSeen) {
  const BuiltTestScene s(scene_with(settings(GetParam()), fmt::format(R"(
loads: [{{surface: x1, force: [0.1, 0, 0], factor: {{type: expression, formula: "{}"}}}}])",
                                                                      kPulse)));
  State last;
  ASSERT_EQ(run_scene(s, 1, [&](const State& state) { last = state; }).status, Outcome::Status::completed);
  const double impulse = 0.1 * std::sqrt(std::numbers::pi) * 0.5e-3;
  EXPECT_NEAR(momentum(s, "linear", last)[0], impulse, 0.03 * impulse);
}

// A body whose support moves suddenly vibrates.
TEST_P(Pulse, OfASupportIsSeen) {
  if (GetParam() == "modal") GTEST_SKIP() << "its supports stand still";
  const BuiltTestScene s(scene_with(settings(GetParam()), fmt::format(R"(
motions: [{{surface: x0, displacement: ["0.01*{}", 0, 0], resolution: 1e-5}}])",
                                                                      kPulse)));
  double fastest = 0;
  run_scene(s, 100, [&](const State& state) {
    fastest = std::max(fastest, state.v.size() > 0 ? state.v.lpNorm<Eigen::Infinity>() : 0);
  });
  EXPECT_GT(fastest, 1e-3);
}

TEST(PulseUnderAFixedStep, IsReportedIfItIsSteppedOver) {
  for (const auto& [step, over] : {std::pair{"0.01", true}, {"1e-4", false}}) {
    const BuiltTestScene s(scene_with(fmt::format("{{type: newmark, step: {}}}", step), fmt::format(R"(
loads: [{{surface: x1, force: [0.1, 0, 0], factor: {{type: expression, formula: "{}"}}}}])",
                                                                                                    kPulse)));
    const Outcome outcome = run_scene(s, 1, [](const State&) {});
    ASSERT_EQ(outcome.stepped_over.has_value(), over) << step;
    if (over) {
      EXPECT_NEAR(*outcome.stepped_over, 0.6, 0.05);
    }
  }
}

}  // namespace
}  // namespace orthodyn::pulses_test
