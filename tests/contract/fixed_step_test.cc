// Common behaviour of integrators with a key `step`: step size, order, dense output.
#include <fmt/format.h>

#include <sstream>

#include "tests/contract/integrators.h"

namespace orthodyn::fixed_step_test {
namespace {

class FixedStep : public testing::TestWithParam<Pair> {
 protected:
  std::unique_ptr<Integrator> make(const SmallModel& model, double step) const {
    return make_integrator(GetParam(), model, {1e-9, 5, fmt::format(", step: {}", step)});
  }
};
INSTANTIATE_TEST_SUITE_P(Registry, FixedStep, testing::ValuesIn(pairs_with("step")), pair_name);

TEST_P(FixedStep, IsTakenAsGivenButForTheLastTwoBeforeAStop) {
  const auto model = damped_oscillator();
  const auto integrator = make(model, 0.1);
  integrator->start(model.initial());
  double before = 0;
  std::vector<double> lengths;
  for (const double stop : {1.0, 1.25, 4.0}) {
    StepInfo info;
    do {
      info = integrator->step(stop);
      EXPECT_NEAR(info.h, info.t - before, 1e-12);
      lengths.push_back(info.h);
      before = info.t;
    } while (info.t < stop);
    EXPECT_EQ(info.t, stop);
  }
  ASSERT_EQ(lengths.size(), 10u + 3u + 28u);
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const bool shares = (k >= 11 && k < 13) || k >= 39;  // 0.15 s before a stop
    const double expected = shares ? 0.075 : 0.1;
    EXPECT_NEAR(lengths[k], expected, 1e-12) << "step " << k;
  }
}

// 20,000 additions of 1e-4 are 2e-13 below 2, more than the round-off margin of the libraries.
TEST_P(FixedStep, LeavesNoSliverOfRoundOffBeforeAStop) {
  const auto model = damped_oscillator();
  const auto integrator = make(model, 1e-4);
  integrator->start(model.initial());
  StepInfo info;
  do {
    info = integrator->step(2);
    ASSERT_GT(info.h, 0.99e-4);
  } while (info.t < 2);
  EXPECT_EQ(integrator->statistics().steps, 20'000);
}

// The slope of log error against log step.
double order_of(const LinearModel& model, const Pair& pair, const std::vector<double>& steps, int order,
                const std::string& more = "", double fraction = 1) {
  std::vector<double> errors;
  for (const double step : steps)
    errors.push_back(largest_error(model, pair, {1e-11, order, fmt::format(", step: {}", step) + more}, fraction));
  return slope(steps, errors);
}

// Small enough for the leading term, large enough for round-off.
std::vector<double> steps_for(int order) {
  switch (order) {
    case 1: return {0.004, 0.002, 0.001};
    case 2: return {0.04, 0.02, 0.01};
    case 3: return {0.04, 0.02, 0.01};
    case 6: return {0.15, 0.12, 0.1, 0.08};
    case 8: return {0.3, 0.25, 0.2, 0.16};
    default: return {0.1, 0.075, 0.05, 0.0375};
  }
}

// Names of all tables, from the sentence of the key.
std::vector<std::string> tables(const std::string& integrator) {
  std::vector<std::string> names;
  for (const auto& key : Registry<IntegratorChoice>::entries().at(integrator).keys) {
    if (key.name != "table") continue;
    std::istringstream in(type_text(key.schema));
    for (std::string name; std::getline(in, name, '|');) names.push_back(name);
  }
  return names;
}

TEST_P(FixedStep, ErrorFallsWithTheOrderThatTheTablesNameEndsIn) {
  if (!has_key(GetParam().integrator, "table")) GTEST_SKIP() << "has no tables";
  const auto names = tables(GetParam().integrator);
  EXPECT_GE(names.size(), 5u);
  for (const auto& name : names) {
    const int order = name.back() - '0';
    const double measured = order_of(harmonic_oscillator(), GetParam(), steps_for(order), order, ", table: " + name);
    EXPECT_NEAR(measured, order, 0.35) << name;
  }
}

TEST_P(FixedStep, ErrorFallsWithItsOrder) {
  if (tested(GetParam().integrator).exact_if_linear) GTEST_SKIP() << "has no error here";
  for (const auto& model : {harmonic_oscillator(), damped_oscillator(), bathes_two_masses()})
    for (const auto& [order, options] : tested(GetParam().integrator).variants)
      EXPECT_NEAR(order_of(model, GetParam(), steps_for(order), order), order, 0.35);
}

TEST_P(FixedStep, ErrorBetweenStepsFallsWithItsOrder) {
  if (tested(GetParam().integrator).exact_if_linear) GTEST_SKIP() << "that of the interpolant alone";
  for (const double fraction : {0.3, 0.7})
    for (const auto& [order, options] : tested(GetParam().integrator).variants)
      EXPECT_NEAR(order_of(harmonic_oscillator(), GetParam(), steps_for(order), order, "", fraction),
                  std::min(order, 5), 0.35)
          << fraction;
}

TEST_P(FixedStep, MayBeMuchLongerThanAStiffTimeScale) {
  const auto& method = tested(GetParam().integrator);
  if (!method.stiff) GTEST_SKIP() << "not for stiff models";
  const int order = method.variants.back().order;
  const double error = order == 1 ? 0.3 : order == 2 ? 1e-2 : order < 5 ? 1e-3 : 1e-4;
  EXPECT_LE(largest_error(stiff_pair(), GetParam(), {1e-8, order, ", step: 0.1"}), error);
}

TEST_P(FixedStep, CountsOnAfterARestart) {
  const auto model = kinked_oscillator();
  const auto integrator = make(model, 0.05);
  long steps = 0, iterations = 0;
  integrate(model, *integrator, [&](const StepInfo&, const Integrator& i) {
    EXPECT_EQ(i.statistics().steps, ++steps);
    if (!solves_systems(GetParam().integrator) || leaves_out_solutions(GetParam())) return;
    EXPECT_GE(i.statistics().solve.count, iterations + 1);
    iterations = i.statistics().solve.count;
  });
  EXPECT_EQ(steps, 80);
  EXPECT_EQ(integrator->statistics().rejected_steps, 0);
}

TEST_P(FixedStep, WhereTheForceFailsEndsInARunErrorThatNamesTheStep) {
  const Disturbed<LinearModel> model(damped_oscillator(), [](long, double t, VectorRef) {
    if (t > 0.45) throw RecoverableError("the door is shut");
  });
  const auto integrator = make(model, 0.1);
  try {
    integrate(model, *integrator);
    FAIL() << "nothing was thrown";
  } catch (const RunError& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find("the door is shut"), std::string::npos) << message;
    EXPECT_NE(message.find("t = 0.4 s"), std::string::npos) << message;
    EXPECT_NE(message.find("lower integrator.step"), std::string::npos) << message;
    EXPECT_TRUE(e.reason() == Reason::force || e.reason() == Reason::newton) << reason_name(e.reason());
  }
}

TEST_P(FixedStep, RefusesTheLimitsOfAnAdaptiveOne) {
  for (const std::string key : {"h0", "h_min", "h_max"}) {
    if (!has_key(GetParam().integrator, key)) continue;
    const auto message = reading_refusal(fmt::format("{{type: {}, step: 0.1, {}: 0.01}}", GetParam().integrator, key));
    EXPECT_NE(message.find(key + ": is not used with a fixed step"), std::string::npos) << message;
  }
}

TEST(ArkodeDirk, RefusesAnUnknownTableWithTheNearestAndAllNames) {
  const auto message = reading_refusal("{type: arkode_dirk, table: ESDIRK547L2SA_7_4_4}");
  EXPECT_NE(message.find("did you mean 'ESDIRK547L2SA_7_4_5'?"), std::string::npos) << message;
  EXPECT_NE(message.find("TRBDF2_3_3_2"), std::string::npos) << message;
  EXPECT_NE(message.find("a.yaml:1:"), std::string::npos) << message;
}

}  // namespace
}  // namespace orthodyn::fixed_step_test
