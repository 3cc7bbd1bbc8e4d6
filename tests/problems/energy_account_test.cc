// Energy balance with stiffness-proportional damping: dissipation equals the work of the loads, for every method.
#include <gtest/gtest.h>

#include "lib/simulation/output/balance.h"
#include "tests/problems/running.h"

namespace orthodyn::energy_account_test {
namespace {

// A suddenly loaded beam comes to rest: half of the work is dissipated, the other half is elastic.
const std::string kBeam = R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [6, 2, 2], order: 1}
materials: {wood: {type: preset, name: sitka_spruce, density: 400}}
elasticity: {kinematics: linear}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, 500]}]
damping: {stiffness: 1e-3}
time: {end: 0.3}
)";

class EnergyAccount : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Integrators, EnergyAccount,
                         testing::Values("arkode_dirk", "backward_euler", "bathe", "cvode_bdf", "energy_momentum",
                                         "exponential_rosenbrock", "generalized_alpha", "hht_alpha", "ida_bdf",
                                         "newmark", "rosenbrock", "sdirk", "semi_implicit_euler", "tr_bdf2"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(EnergyAccount, OfABeamThatComesToRestIsClosed) {
  const bool first_order = std::string(GetParam()).find("euler") != std::string::npos;
  const BuiltTestScene s(kBeam + "integrator: {type: " + GetParam() + "}\n");
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  EnergyMeter meter(s.model(), *integrator);
  const Outcome outcome =
      run(s.model(), *integrator, s.built.initial, {s.scene.time.end, {}, false}, {&meter}, {false});
  ASSERT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  const EnergyBalance& e = meter.last();
  EXPECT_LE(e.kinetic, 1e-6 * e.loads);
  const double tolerance = first_order ? 0.05 : 0.01;
  EXPECT_NEAR(e.elastic, e.loads / 2, tolerance * e.loads);
  EXPECT_NEAR(e.dissipated, e.loads / 2, tolerance * e.loads);
}

}  // namespace
}  // namespace orthodyn::energy_account_test
