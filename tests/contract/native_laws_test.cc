// Properties of the native implicit methods besides their order: energy, damping at infinity, coefficients.
#include <numbers>

#include "integrators/native/ros34pw2.h"
#include "tests/contract/integrators.h"

namespace orthodyn::native_laws_test {
namespace {

LinearModel undamped(double omega, const Vector& start = Vector::Ones(1)) {
  return LinearModel(
      {.mass = scalar(1), .stiffness = scalar(omega * omega), .start = start, .end = 1, .velocity_scale = omega});
}

std::unique_ptr<Integrator> integrator_of(const SmallModel& model, const std::string& options, double h) {
  const auto choice = Registry<IntegratorChoice>::read(
      Config::from_text(fmt::format("{{type: {}, rtol: 1e-11, step: {}}}", options, h)));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), 1, 1});
}

State after_steps(const SmallModel& model, const std::string& options, int steps, double h) {
  const auto integrator = integrator_of(model, options, h);
  integrator->start(model.initial());
  for (int k = 0; k < steps; ++k) integrator->step(1e9);
  State state;
  integrator->interpolate(steps * h, state);
  return state;
}

// Damping of a motion a million times faster than the step: rho in the amplitude k^p rho^k after k steps. Coinciding
// roots at infinity cause the powers of k.
double left_at_infinity(const std::string& options) {
  const auto model = undamped(1e6);
  const auto log_amplitude = [&](int steps) {
    const State s = after_steps(model, options, steps, 1);
    return std::log(std::hypot(s.q[0], s.v[0] / 1e6));
  };
  const double early = log_amplitude(8), middle = log_amplitude(16), late = log_amplitude(32);
  return std::exp(((late - middle) - (middle - early)) / 8);
}

TEST(AlphaMethods, LeaveOfFastOscillationsWhatTheirParameterSays) {
  for (const double rho : {0.5, 0.8})
    EXPECT_NEAR(left_at_infinity(fmt::format("generalized_alpha, rho_inf: {}", rho)), rho, 0.03) << rho;
  for (const double alpha : {-0.05, -0.1})
    EXPECT_NEAR(left_at_infinity(fmt::format("hht_alpha, alpha: {}", alpha)), (1 + alpha) / (1 - alpha), 0.03) << alpha;
}

// A stop every 10.01 steps: a remaining step of a hundredth would amplify fast motion by a factor of 47 per stop.
TEST(AlphaMethods, AreNotExcitedByStopsBetweenTheirSteps) {
  constexpr double h = 0.1;
  for (const std::string method :
       {"generalized_alpha, rho_inf: 0", "generalized_alpha, rho_inf: 0.5", "generalized_alpha, rho_inf: 0.8",
        "hht_alpha, alpha: -0.05", "hht_alpha, alpha: -0.3"})
    for (const double omega : {1.0, 10.0, 1e2, 1e4}) {
      const auto model = undamped(omega);
      const auto integrator = integrator_of(model, method, h);
      integrator->start(model.initial());
      State state;
      for (int stop = 1; stop <= 30; ++stop) {
        const double t_stop = stop * 10.01 * h;
        while (integrator->step(t_stop).t < t_stop) continue;
        integrator->interpolate(t_stop, state);
      }
      EXPECT_LE(std::hypot(state.v[0] / omega, state.q[0]), 1 + 1e-2) << method << ", omega " << omega;
    }
}

// The force at the interpolated mid-step state, a rod shortened by its rotation, would add energy.
TEST(AlphaMethods, GainNoEnergyWhereAStiffRodTurns) {
  const auto model = pendulum();
  const double at_start = model.energy(model.initial());
  for (const std::string method : {"generalized_alpha, rho_inf: 0.5", "generalized_alpha, rho_inf: 0.8",
                                   "generalized_alpha, rho_inf: 1", "hht_alpha, alpha: -0.3"})
    for (const double h : {0.1, 0.3}) {
      double most = at_start;
      for (int steps = 1; steps <= 60; ++steps)
        most = std::max(most, model.energy(after_steps(model, method, steps, h)));
      EXPECT_LE(most - at_start, 0.05) << method << ", step " << h;
    }
}

TEST(Bathe, LeavesOfFastOscillationsWhatItsParameterSays) {
  for (const double rho : {0.5, 0.8})
    for (const double splitting : {0.3, 0.5})
      EXPECT_NEAR(left_at_infinity(fmt::format("bathe, rho_inf: {}, splitting: {}", rho, splitting)), rho, 1e-3)
          << rho << " " << splitting;
}

TEST(LStableMethods, LeaveNothingOfFastOscillations) {
  const auto model = undamped(1e6);
  for (const std::string method : {"backward_euler", "semi_implicit_euler", "tr_bdf2", "bathe", "sdirk, order: 2",
                                   "sdirk, order: 3", "sdirk, order: 4", "rosenbrock"}) {
    const State s = after_steps(model, method, 3, 1);
    EXPECT_LE(std::hypot(s.q[0], s.v[0] / 1e6), 1e-4) << method;
  }
}

TEST(TrapezoidalRule, KeepsTheEnergyOfALinearModel) {
  const auto model = undamped(3);
  for (const std::string method : {"newmark", "bathe, rho_inf: 1", "hht_alpha, alpha: 0", "newmark, newton: full"}) {
    const State s = after_steps(model, method, 2000, 0.3);
    EXPECT_NEAR(0.5 * s.v[0] * s.v[0] + 4.5 * s.q[0] * s.q[0], 4.5, 1e-8) << method;
  }
}

// The amplification factor for q'' = -omega^2 q is 1 / (1 - i omega h).
TEST(BackwardEuler, DampsAsItsFormulaSays) {
  const State s = after_steps(undamped(2), "backward_euler", 10, 0.1);
  EXPECT_NEAR(std::hypot(s.q[0], s.v[0] / 2), std::pow(1 + 0.04, -5), 1e-9);
}

// On a linear model Newton's first iteration is exact.
TEST(SemiImplicitEuler, IsBackwardEulerOnALinearModel) {
  const auto model = damped_oscillator();
  const State a = after_steps(model, "semi_implicit_euler", 10, 0.05);
  const State b = after_steps(model, "backward_euler", 10, 0.05);
  EXPECT_LE(distance(a, b, model.scales()), 1e-9);
}

// Rang & Angermann (2005): with an arbitrary matrix instead of the Jacobian, order three needs eight conditions.
TEST(Rosenbrock, CoefficientsSatisfyTheConditionsForAnyMatrix) {
  const Ros34Pw2 r;
  const Eigen::Vector4d one = Eigen::Vector4d::Ones(), c = r.alpha * one, g = r.gamma * one;
  const auto expect = [](double found, double wanted) { EXPECT_NEAR(found, wanted, 1e-14); };
  expect(r.b.dot(one), 1);
  expect(r.b.dot(c), 1.0 / 2);
  expect(r.b.dot(g), 0);
  expect(r.b.dot(c.cwiseProduct(c)), 1.0 / 3);
  expect(r.b.dot(r.alpha * c), 1.0 / 6);
  expect(r.b.dot(r.alpha * g), 0);
  expect(r.b.dot(r.gamma * c), 0);
  expect(r.b.dot(r.gamma * g), 0);
  expect(r.embedded.dot(one), 1);
  expect(r.embedded.dot(c), 1.0 / 2);
  expect(r.embedded.dot(g), 0);
  EXPECT_GT(std::abs(r.embedded.dot(c.cwiseProduct(c)) - 1.0 / 3), 1e-3);
}

TEST(Rosenbrock, StaysOfOrderThreeWithATangentTenStepsOld) {
  const auto model = pendulum();
  const auto end = [&](const std::string& options) {
    const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{type: " + options + "}"));
    return integrate(model, *choice->make(model, {[&] { return model.scales(); }, model.initial(), 1, 1}));
  };
  const State exact = end("arkode_dirk, rtol: 1e-11");
  std::vector<double> steps = {0.004, 0.002, 0.001}, errors;
  for (const double h : steps)
    errors.push_back(distance(end(fmt::format("rosenbrock, tangent_steps: 10, step: {}", h)), exact, {1, 1}));
  EXPECT_NEAR(slope(steps, errors), 3, 0.35);
}

TEST(Newmark, RefusesParametersWithWhichStiffModesGrow) {
  try {
    Registry<IntegratorChoice>::read(Config::from_text("{type: newmark, beta: 0.1}", "a.yaml"));
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("at least gamma / 2 = 0.25"), std::string::npos) << e.what();
  }
}

TEST(NativeMethods, RefuseSundialsOwnSolverWithTheRemedy) {
  try {
    Registry<IntegratorChoice>::read(Config::from_text("{type: tr_bdf2, linear_solver: klu_full}", "a.yaml"));
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("'klu_full' is for SUNDIALS' integrators"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace orthodyn::native_laws_test
