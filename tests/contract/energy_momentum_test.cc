// The energy-momentum method conserves its invariants at steps far above an explicit method's limit.
#include "integrators/critical_step.h"
#include "lib/simulation/run/setup.h"
#include "tests/contract/integrators.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::energy_momentum_test {
namespace {

// A free, slightly stretched, spinning block, ten times stiffer along oblique fibres.
BuiltTestScene spinning_block(const std::string& more = "") {
  return BuiltTestScene(
      "mesh: {type: box, size: [1, 1, 1], cells: [2, 2, 1], order: 1}\n"
      "materials: {m: {type: orthotropic_stable, density: 1, young: [3000, 300, 300], nu: 0.3}}\nregions: {all: "
      "{material: m, axes: " +
      kTurnedAxes + "}}\n" +
      "initial: {spin: [0.15, 0.3, 0.6], deformation_gradient: [[1.02, 0, 0], [0, 1, 0], [0, 0, 1]]}\n" +
      "time: {end: 1000}\n" + more);
}

struct Drift {
  double energy = 0, linear = 0,
         angular = 0;  // relative to kinetic plus elastic energy, and to the angular momentum of the spin
};

Drift drift(const BuiltTestScene& s, double step, int steps) {
  const auto choice =
      Registry<IntegratorChoice>::read(Config::from_text(fmt::format("{{type: energy_momentum, step: {}}}", step)));
  const auto integrator = choice->make(s.model(), task_of(s.scene, s.built));
  const auto vector = [&](const char* name, const State& state) {
    const auto values = s.model().evaluate(name, state);
    return Vec3(values[0], values[1], values[2]);
  };
  const auto energy = [&](const State& state) {
    return s.model().evaluate("energy.kinetic", state)[0] + s.model().evaluate("energy.elastic", state)[0];
  };
  State state = s.built.initial;
  const double first_energy = energy(state);
  const Vec3 first_linear = vector("momentum.linear", state), first_angular = vector("momentum.angular", state);
  integrator->start(state);
  Drift largest;
  for (int k = 1; k <= steps; ++k) {
    integrator->interpolate(integrator->step(1e9).t, state);
    if (k % 50 != 0) continue;
    const auto keep_largest = [](double& most, double value) { most = std::max(most, value); };
    keep_largest(largest.energy, std::abs(energy(state) - first_energy) / first_energy);
    keep_largest(largest.linear, (vector("momentum.linear", state) - first_linear).norm() / first_angular.norm());
    keep_largest(largest.angular, (vector("momentum.angular", state) - first_angular).norm() / first_angular.norm());
  }
  return largest;
}

TEST(EnergyMomentum, KeepsEnergyAndMomentumOverTenThousandStepsOfTwentyTimesTheExplicitLimit) {
  const auto block = spinning_block();
  Statistics unused;
  const double critical = CriticalStep(block.model(), unused).at(block.built.initial);
  const Drift d = drift(block, 20 * critical, 10'000);
  EXPECT_LE(d.energy, 1e-10);
  EXPECT_LE(d.linear, 1e-10);
  EXPECT_LE(d.angular, 1e-10);
}

}  // namespace
}  // namespace orthodyn::energy_momentum_test
