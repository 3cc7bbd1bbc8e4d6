// Events happen where every integrator's own dense output has them.
#include <cmath>
#include <numbers>

#include "lib/run/run.h"
#include "tests/contract/integrators.h"

namespace orthodyn {
namespace {

class Events : public testing::TestWithParam<Pair> {};

INSTANTIATE_TEST_SUITE_P(Registry, Events, testing::ValuesIn(all_pairs()), pair_name);

struct Watch : Observer {
  void on_event(const Crossing& crossing) override { crossings.push_back(crossing); }
  void on_output(const State& state) override { outputs.push_back(state); }
  void on_step(const StepInfo& info, const State& state, const Integrator&) override {
    steps.push_back(info);
    last = state;
  }
  std::vector<Crossing> crossings;
  std::vector<State> outputs;
  std::vector<StepInfo> steps;
  State last;
};

double position(const State& state) { return state.q[0]; }

Outcome run_with(const Pair& pair, const LinearModel& model, std::vector<Event> events, Watch& watch) {
  EventFinder finder(std::move(events));
  const auto integrator = make_integrator(pair, model, {.rtol = 1e-6});
  Plan plan{model.end(), evenly_spaced(0, model.end(), 10)};
  plan.events = &finder;
  Outcome outcome = run(model, *integrator, model.initial(), plan, {&watch}, {false});
  for (auto& crossing : watch.crossings) crossing.event = nullptr;  // it has died with the finder
  return outcome;
}

// q = cos 3t.
TEST_P(Events, ComeAtTheTimesOfTheExactSolution) {
  const auto model = harmonic_oscillator();
  Watch watch;
  const Outcome outcome = run_with(GetParam(), model, {{"third", position, 0.3}}, watch);
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  EXPECT_EQ(outcome.remark, "");
  const double first = std::acos(0.3) / 3, period = 2 * std::numbers::pi / 3;
  const std::vector<double> expected{first, period - first, period + first, 2 * period - first, 2 * period + first};
  ASSERT_EQ(watch.crossings.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(watch.crossings[k].state.t, expected[k], 2e-2) << k;  // some hundred rtol per period, in phase
    EXPECT_NEAR(watch.crossings[k].state.q[0], 0.3, 1e-11) << "not where the dense output has it";
    EXPECT_EQ(watch.crossings[k].upward, k % 2 == 1);
  }
}

TEST_P(Events, ThatStopEndTheRunWhereTheyHappen) {
  const auto model = harmonic_oscillator();
  Watch watch;
  const Outcome outcome = run_with(
      GetParam(), model, {{"down", position, 0.9, Direction::down}, {"turn", position, -0.5, Direction::up, true}}, watch);
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  EXPECT_NE(outcome.remark.find("stopped by the event 'turn' at t = 1.39"), std::string::npos) << outcome.remark;
  EXPECT_NEAR(outcome.last.t, 4 * std::numbers::pi / 9, 5e-3);
  EXPECT_NEAR(outcome.last.q[0], -0.5, 1e-11);
  EXPECT_EQ(watch.crossings.size(), 2u);
  ASSERT_FALSE(watch.outputs.empty());
  EXPECT_EQ(watch.outputs.back().t, outcome.last.t);
  EXPECT_EQ(watch.steps.back().t, outcome.last.t);
  EXPECT_EQ(watch.last.q, outcome.last.q);
  double t = 0;
  for (const auto& step : watch.steps) EXPECT_NEAR(t += step.h, step.t, 1e-9);
}

}  // namespace
}  // namespace orthodyn
