// Intermittent contact does not create energy, whether softer or much stiffer than the body.
#include <gtest/gtest.h>

#include "lib/simulation/output/balance.h"
#include "tests/problems/running.h"

namespace orthodyn::contact_test {
namespace {

struct Fall {
  const char* integrator;
  const char* stiffness;  // Pa/m
  double rtol;
};

void PrintTo(const Fall& fall, std::ostream* out) {
  *out << fall.integrator << ", " << fall.stiffness << " Pa/m, rtol " << fall.rtol;
}

std::vector<Fall> falls() {
  std::vector<Fall> all;
  for (const char* integrator :
       {"cvode_bdf", "ida_bdf", "newmark", "tr_bdf2", "generalized_alpha", "energy_momentum", "arkode_dirk"})
    for (const char* stiffness : {"1e5", "1e8", "1e11"})
      for (const double rtol : {1e-2, 1e-3}) all.push_back({integrator, stiffness, rtol});
  return all;
}

class Contact : public testing::TestWithParam<Fall> {};

// BDF with a single Newton correction at a kink created up to 3,000 times the initial energy.
TEST_P(Contact, MakesNoEnergy) {
  const Fall& fall = GetParam();
  const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2], origin: [0, 0, 0.05], order: 1}}
materials: {{rubber: {{type: orthotropic_stable, density: 1000, young: [1e6, 5e5, 2e5], nu: 0.3}}}}
terms: [{{type: ground_contact, stiffness: {}}}]
gravity: [0, 0, -9.81]
time: {{end: 0.3}}
integrator: {{type: {}, rtol: {}}}
)",
                                     fall.stiffness, fall.integrator, fall.rtol));
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  struct Gain : EnergyMeter {
    using EnergyMeter::EnergyMeter;
    void on_step(const StepInfo& info, const ObservedState& observed, const Integrator& i) override {
      EnergyMeter::on_step(info, observed, i);
      largest = std::max(largest, change());
    }
    double largest = 0;
  } energy(s.model(), *integrator);
  const Outcome outcome =
      run(s.model(), *integrator, s.built.initial, {s.scene.time.end, {}, false}, {&energy}, {false});
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  const double fallen = 1 * 9.81 * 0.05;    // J, kg m/s^2 m
  EXPECT_GT(energy.scale(), 0.9 * fallen);  // after the fall; soft ground lets it fall further
  const double rtols = std::string(fall.integrator) == "arkode_dirk" ? 50 : 10;
  EXPECT_LE(energy.largest, rtols * fall.rtol * fallen);
  if (fall.rtol < 1e-2) {
    EXPECT_GT(energy.change(), -0.5 * fallen);  // it bounces
  }
}

INSTANTIATE_TEST_SUITE_P(Ground, Contact, testing::ValuesIn(falls()));

// Linearly implicit steps leave an imbalance with a constant sign in a stiff rotating body.
TEST(Pendulum, OnOneNodeGainsNoEnergyByRosenbrocksMethod) {
  const BuiltTestScene s(R"(
mesh: {type: box, size: [0.1, 0.1, 0.5], cells: [2, 2, 6], order: 1}
materials: {m: {type: orthotropic_stable, density: 1000, young: [1e6, 5e5, 2e5], nu: 0.3}}
gravity: [10, 0, 0]
clamps: [{nearest: [0, 0, 0.5]}]
time: {end: 1}
integrator: {type: rosenbrock}
)");
  const auto integrator = s.scene.integrator->make(s.model(), task_of(s.scene, s.built));
  EnergyMeter energy(s.model(), *integrator);
  const Outcome outcome =
      run(s.model(), *integrator, s.built.initial, {s.scene.time.end, {}, false}, {&energy}, {false});
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  EXPECT_LE(energy.drift(), 5e-3 * energy.scale());
}

}  // namespace
}  // namespace orthodyn::contact_test
