// Common behaviour of all integrators besides accuracy: stops, failures, statistics, refusals.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "tests/contract/integrators.h"

namespace orthodyn::behaviour_test {
namespace {

class Contract : public testing::TestWithParam<Pair> {
 protected:
  std::unique_ptr<Integrator> make(const SmallModel& model, const Options& options = {}) const {
    return make_integrator(GetParam(), model, options);
  }
  // The RunError that ends the run.
  RunError error(const SmallModel& model, const Options& options = {}) const {
    const auto integrator = make(model, options);
    try {
      integrate(model, *integrator);
    } catch (const RunError& e) {
      return e;
    }
    return RunError("");
  }
  std::string failure(const SmallModel& model, const Options& options = {}) const {
    return error(model, options).what();
  }
};
INSTANTIATE_TEST_SUITE_P(Registry, Contract, testing::ValuesIn(all_pairs()), pair_name);

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

double time_in(const std::string& message) {
  const auto at = message.find("t = ");
  return at == std::string::npos ? -1 : std::strtod(message.c_str() + at + 4, nullptr);
}

TEST_P(Contract, StepsEndExactlyOnTheTimesAskedFor) {
  const auto model = damped_oscillator();
  const auto integrator = make(model);
  integrator->start(model.initial());
  double before = 0;
  for (const double stop : {1e-5, 0.1, 1.0 / 3, 0.5, 0.50001, 2.0, std::nextafter(2.5, 3), 4.0}) {
    StepInfo info;
    do {
      info = integrator->step(stop);
      EXPECT_GT(info.t, before);
      ASSERT_LE(info.t, stop);
      before = info.t;
    } while (info.t < stop);
    EXPECT_EQ(info.t, stop);
    State state;
    integrator->interpolate(stop, state);
    EXPECT_EQ(state.t, stop);
    EXPECT_LE(distance(state, model.exact(stop), model.scales()), 1e-2);
  }
}

TEST_P(Contract, AStepSaysItsLengthAndOrder) {
  const auto model = damped_oscillator();
  double before = 0;
  integrate(model, *make(model, {1e-5, 2}), [&](const StepInfo& info, const Integrator&) {
    EXPECT_NEAR(info.h, info.t - before, 1e-12);
    EXPECT_GE(info.order, 1);
    EXPECT_LE(info.order, variant(GetParam().integrator, 2).order);
    before = info.t;
  });
}

TEST_P(Contract, ARestartAtABreakpointGoesOnFromTheGivenStateAndKeepsCounting) {
  const auto model = kinked_oscillator();
  const auto integrator = make(model);
  long steps = 0;
  double last = 0;
  integrate(model, *integrator, [&](const StepInfo& info, const Integrator& i) {
    EXPECT_EQ(i.statistics().steps, ++steps);
    for (const double kink : {1.0, 2.0}) EXPECT_FALSE(last < kink && info.t > kink) << "stepped across " << kink;
    last = info.t;
  });
}

// A model at rest starts to move when its load sets in.
TEST_P(Contract, ALoadAfterALongRestIsNotMissed) {
  const LinearModel model({.mass = scalar(1),
                           .stiffness = scalar(9),
                           .beta = 0.05,
                           .load = Vector::Constant(1, 9),
                           .factor = {{1000, 0}, {1000.5, 1}},
                           .end = 1002,
                           .velocity_scale = 3});
  const State last = integrate(model, *make(model));
  EXPECT_LE(distance(last, model.exact(1002), model.scales()), 1e-2);
}

// Starts at rest under 200 sin(W t), W = 20 pi/s. The load is equal at the start, at the end and after whole periods,
// so that coarse samples see no change. x = 200/(9 - W^2) (sin W t - W/3 sin 3 t).
TEST_P(Contract, APeriodicLoadIsNotTakenForNone) {
  const LinearModel still({.mass = scalar(1), .stiffness = scalar(9), .load = Vector::Zero(1), .end = 0.5});
  constexpr double W = 20 * std::numbers::pi;
  const Disturbed<LinearModel> model(still, [](long, double t, VectorRef f) { f[0] += 200 * std::sin(W * t); });
  const State last = integrate(model, *make(model, {.rtol = 1e-4}));
  const double exact = -200 / (9 - W * W) * W / 3 * std::sin(1.5);
  EXPECT_NEAR(last.q[0], exact, 0.05 * exact);  // fixed-step methods take steps of 0.01 s, a tenth of a period
}

TEST_P(Contract, TheSameRunTwiceIsTheSameToTheLastBit) {
  if (tested(GetParam().integrator).linear_only) GTEST_SKIP() << "serves linear models only";
  const auto model = pendulum();
  const State a = integrate(model, *make(model)), b = integrate(model, *make(model));
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.v, b.v);
}

TEST_P(Contract, ARecoverableModelErrorOnlyShortensTheStep) {
  if (!controls_its_error(GetParam().integrator)) GTEST_SKIP() << "takes fixed steps only";
  const Disturbed<LinearModel> model(damped_oscillator(), [](long call, double, VectorRef) {
    if (call == 40 || call == 41) throw RecoverableError("not this state");
  });
  const auto integrator = make(model);
  const State last = integrate(model, *integrator);
  EXPECT_GE(integrator->statistics().rejected_steps, 1);
  EXPECT_LE(distance(last, model.exact(last.t), model.scales()), 1e-2);
}

TEST_P(Contract, AForceThatIsNotANumberOnlyShortensTheStep) {
  if (!controls_its_error(GetParam().integrator)) GTEST_SKIP() << "takes fixed steps only";
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const Disturbed<LinearModel> model(damped_oscillator(), [wrong](long call, double, VectorRef f) {
      if (call == 40 || call == 41) f[0] = wrong;
    });
    const auto integrator = make(model);
    const State last = integrate(model, *integrator);
    EXPECT_GE(integrator->statistics().rejected_steps, 1);
    EXPECT_LE(distance(last, model.exact(last.t), model.scales()), 1e-2);
  }
}

TEST_P(Contract, APersistentModelErrorEndsInARunErrorWithTimeCauseAndRemedy) {
  const Disturbed<LinearModel> model(damped_oscillator(), [](long, double t, VectorRef) {
    if (t > 0.5) throw RecoverableError("the door is shut");
  });
  const std::string message = failure(model);
  EXPECT_GT(time_in(message), 0.3) << message;
  EXPECT_LE(time_in(message), 0.51) << message;  // some evaluate the force before the end of a step
  EXPECT_TRUE(contains(message, GetParam().integrator)) << message;
  EXPECT_TRUE(contains(message, "the door is shut")) << message;
  EXPECT_TRUE(contains(message, "h_max") || contains(message, "rtol") || contains(message, "step")) << message;
}

TEST_P(Contract, AModelErrorAtTheInitialStateEndsInARunErrorWithTimeAndCause) {
  const Disturbed<LinearModel> model(damped_oscillator(),
                                     [](long, double, VectorRef) { throw RecoverableError("the door is shut"); });
  const std::string message = failure(model);
  EXPECT_EQ(time_in(message), 0) << message;
  EXPECT_TRUE(contains(message, "the door is shut")) << message;
}

TEST_P(Contract, AnInitialForceThatIsNotANumberEndsInARunError) {
  const Disturbed<LinearModel> model(damped_oscillator(), [](long, double, VectorRef f) { f[0] = std::nan(""); });
  EXPECT_TRUE(contains(failure(model), "not finite")) << failure(model);
}

struct Surprise {
  int number;
};

TEST_P(Contract, AnyOtherExceptionPassesThroughUnharmed) {
  const Disturbed<LinearModel> model(damped_oscillator(), [](long call, double, VectorRef) {
    if (call == 30) throw Surprise{42};
  });
  const auto integrator = make(model);
  try {
    integrate(model, *integrator);
    FAIL() << "nothing was thrown";
  } catch (const Surprise& e) {
    EXPECT_EQ(e.number, 42);
  }
}

TEST_P(Contract, StatisticsAddUp) {
  if (tested(GetParam().integrator).linear_only) GTEST_SKIP() << "serves linear models only";
  const auto model = pendulum();
  const auto integrator = make(model, {1e-4, 5});
  long steps = 0;
  integrate(model, *integrator, [&](const StepInfo&, const Integrator&) { ++steps; });
  const Statistics& s = integrator->statistics();
  EXPECT_EQ(s.steps, steps);
  EXPECT_EQ(s.rejected_steps, s.error_test_failures + s.convergence_failures);
  EXPECT_GE(s.force.count, s.steps);
  EXPECT_GT(s.force.seconds, 0);
  EXPECT_GE(s.force.count, s.newton_iterations);
  if (solves_systems(GetParam().integrator)) {
    if (!leaves_out_solutions(GetParam())) {
      EXPECT_GE(s.solve.count, std::max(s.steps, s.newton_iterations));
    }
    EXPECT_GT(s.tangent.count, 0);
    EXPECT_GE(s.factorization.count, s.tangent.count);
    EXPECT_GT(s.tangent.seconds, 0);
  }
  EXPECT_GT(integrator->bytes(), 0u);
}

TEST_P(Contract, SaysWhatItDecided) {
  if (!controls_its_error(GetParam().integrator)) GTEST_SKIP() << "takes fixed steps only";
  const auto model = damped_oscillator();
  std::map<std::string, std::string> decided;
  for (const auto& [key, value] : make(model)->decisions()) decided[key] = value;
  EXPECT_EQ(decided["position_scale"], "1");
  EXPECT_EQ(decided["velocity_scale"], "3");
  if (solves_systems(GetParam().integrator)) {
    EXPECT_TRUE(contains(decided["linear_solver"], GetParam().solver));
  }
}

TEST_P(Contract, TooManyStepsEndInARunErrorThatNamesTheLimit) {
  const std::string message = failure(harmonic_oscillator(), {1e-6, 2, ", max_steps: 20"});
  EXPECT_TRUE(contains(message, "max_steps")) << message;
  EXPECT_TRUE(contains(message, "20 steps")) << message;
  EXPECT_GT(time_in(message), 0) << message;
}

TEST_P(Contract, StepsStayWithinTheirLimits) {
  if (!controls_its_error(GetParam().integrator)) GTEST_SKIP() << "takes fixed steps only";
  const auto model = damped_oscillator();
  integrate(model, *make(model, {1e-3, 2, ", h_max: 0.01"}),
            [](const StepInfo& info, const Integrator&) { EXPECT_LE(info.h, 0.01 * (1 + 1e-12)); });
}

TEST_P(Contract, AFailureHasAReason) {
  EXPECT_EQ(error(harmonic_oscillator(), {1e-6, 2, ", max_steps: 20"}).reason(), Reason::too_many_steps);
  const Disturbed<LinearModel> nowhere(damped_oscillator(),
                                       [](long, double, VectorRef) { throw RecoverableError("no"); });
  EXPECT_EQ(error(nowhere).reason(), Reason::force);
}

// A damped oscillator released from `amplitude`.
LinearModel released_from(double amplitude) {
  return LinearModel(
      {.mass = scalar(2), .stiffness = scalar(18), .beta = 0.4 / 3, .start = Vector::Constant(1, amplitude), .end = 4});
}

TEST_P(Contract, AMotionAMillionTimesLargerWithItsScalesTakesTheSameSteps) {
  if (!has_key(GetParam().integrator, "position_scale")) GTEST_SKIP() << "has no scales";
  const auto steps = [&](double amplitude) {
    const auto model = released_from(amplitude);
    const auto integrator =
        make(model, {1e-5, 2, fmt::format(", position_scale: {}, velocity_scale: {}", amplitude, 3 * amplitude)});
    integrate(model, *integrator);
    return integrator->statistics().steps;
  };
  EXPECT_EQ(steps(1e6), steps(1));
  EXPECT_EQ(steps(1e-6), steps(1));
}

// A thousand times smaller scale requires a thousand times smaller error.
TEST_P(Contract, ASmallerScaleOfEitherKindCostsSteps) {
  if (!has_key(GetParam().integrator, "position_scale")) GTEST_SKIP() << "has no scales";
  if (tested(GetParam().integrator).exact_if_linear) GTEST_SKIP() << "has no error here";
  const auto steps = [&](double position, double velocity) {
    const auto model = released_from(1);
    const auto integrator =
        make(model, {1e-4, 2, fmt::format(", position_scale: {}, velocity_scale: {}", position, velocity)});
    integrate(model, *integrator);
    return integrator->statistics().steps;
  };
  // Three decades of rtol cost a method of order k a factor of 10^(3/(k+1)) in steps; ten for order two.
  const double k = variant(GetParam().integrator, 2).order;
  const long usual = steps(1, 3);
  const auto least = static_cast<long>(0.5 * std::pow(10, 3 / (k + 1)) * static_cast<double>(usual));
  EXPECT_GT(steps(1e-3, 3), least);
  EXPECT_GT(steps(1, 3e-3), least);
}

bool looks_at_definiteness(const std::string& solver) {
  return solver_registry().contains(solver) && !solver_registry().at(solver).takes_general;
}

// The column's transverse stiffness is negative: as it comes to rest, the steps grow until the Newton
// matrix is indefinite.
TEST_P(Contract, AnIndefiniteTangentFallsBackToGaussNewtonWhichIsCounted) {
  if (!solves_systems(GetParam().integrator)) GTEST_SKIP() << "solves no systems";
  if (tested(GetParam().integrator).keeps_energy) GTEST_SKIP() << "takes no step as long where much is damped";
  if (!controls_its_error(GetParam().integrator)) GTEST_SKIP() << "takes fixed steps only";
  if (!tested(GetParam().integrator).stiff) GTEST_SKIP() << "takes short steps only";
  const auto model = upright_column();
  const auto integrator = make(model, {1e-3, 2});
  constexpr double kEnd = 1000;  // at rest, with steps as long as the tangent allows
  State state = model.initial();
  integrator->start(state);
  StepInfo info;
  do info = integrator->step(kEnd);
  while (info.t < kEnd);
  integrator->interpolate(kEnd, state);
  EXPECT_NEAR(state.q[0], 0, 1e-12);
  EXPECT_NEAR(state.q[1], 1 - SpringPendulum::kGravity / SpringPendulum::kStiffness, 1e-4);
  if (looks_at_definiteness(GetParam().solver)) EXPECT_GT(integrator->statistics().gauss_newton_fallbacks, 0);
  else EXPECT_EQ(integrator->statistics().gauss_newton_fallbacks, 0);
}

TEST_P(Contract, AConsistentMassIsServedOrRefusedWithTheRemedy) {
  const auto model = chain(true);
  if (!refuses_consistent_mass(GetParam())) {
    EXPECT_NO_THROW(make(model));
    return;
  }
  try {
    make(model);
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_TRUE(contains(e.what(), "mass: lumped")) << e.what();
    EXPECT_TRUE(contains(e.what(), "ida_bdf")) << e.what();
  }
}

TEST_P(Contract, AnUnsymmetricTangentIsServedOrRefusedWithTheRemedy) {
  if (tested(GetParam().integrator).linear_only) GTEST_SKIP() << "serves linear models only";
  const CirculatoryModel model;
  if (!looks_at_definiteness(GetParam().solver)) {
    EXPECT_NO_THROW(make(model));
    return;
  }
  try {
    make(model);
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_TRUE(contains(e.what(), "klu")) << e.what();
    EXPECT_TRUE(contains(e.what(), GetParam().solver)) << e.what();
  }
}

}  // namespace
}  // namespace orthodyn::behaviour_test
