// Events are located on each integrator's dense output.
#include <numbers>

#include "lib/simulation/run/run.h"
#include "tests/contract/integrators.h"

namespace orthodyn::events_test {
namespace {

class Events : public testing::TestWithParam<Pair> {};

INSTANTIATE_TEST_SUITE_P(Registry, Events, testing::ValuesIn(all_pairs()), pair_name);

struct Watch : Observer {
  void on_event(const Crossing& crossing) override { crossings.push_back(crossing); }
  void on_output(const ObservedState& observed) override { outputs.push_back(observed.state()); }
  void on_step(const StepInfo& info, const ObservedState& observed, const Integrator&) override {
    steps.push_back(info);
    last = observed.state();
  }
  std::vector<Crossing> crossings;
  std::vector<State> outputs;
  std::vector<StepInfo> steps;
  State last;
};

double position(const ObservedState& observed) { return observed.state().q[0]; }

Outcome run_with(const Pair& pair, const LinearModel& model, std::vector<Event> events, Watch& watch) {
  EventFinder finder(std::move(events));
  const auto integrator = make_integrator(pair, model, {.rtol = 1e-6});
  Plan plan{model.end(), evenly_spaced(0, model.end(), 10)};
  plan.events = &finder;
  Outcome outcome = run(model, *integrator, model.initial(), plan, {&watch}, {false});
  for (auto& crossing : watch.crossings) crossing.event = nullptr;  // the event is destroyed with the finder
  return outcome;
}

struct SignChange {
  double before, after;
  bool upward;
};

// Roots of q - value from a hundred samples per step of a run without events.
std::vector<SignChange> sign_changes(const Pair& pair, const LinearModel& model, double value) {
  std::vector<SignChange> found;
  const auto integrator = make_integrator(pair, model, {.rtol = 1e-6});
  integrate(model, *integrator, [&](const StepInfo& info, const Integrator& i) {
    State before, after;
    i.interpolate(info.t - info.h, before);
    for (int look = 1; look <= 100; ++look, before = after) {
      i.interpolate(info.t - info.h * (100 - look) / 100, after);
      const bool below = before.q[0] < value;
      if (below != (after.q[0] < value)) found.push_back({before.t, after.t, below});
    }
  });
  return found;
}

// q = cos 3t, damped by some methods.
TEST_P(Events, ComeWhereTheDenseOutputHasThem) {
  const auto model = harmonic_oscillator();
  Watch watch;
  const Outcome outcome = run_with(GetParam(), model, {{"third", position, 0.3}}, watch);
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  EXPECT_EQ(outcome.remark, "");
  const auto expected = sign_changes(GetParam(), model, 0.3);
  EXPECT_EQ(expected.size(), 6u);
  ASSERT_EQ(watch.crossings.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const Crossing& crossing = watch.crossings[k];
    EXPECT_GE(crossing.state.t, expected[k].before);
    EXPECT_LE(crossing.state.t, expected[k].after);
    EXPECT_EQ(crossing.upward, expected[k].upward);
    EXPECT_NEAR(crossing.state.q[0], 0.3, 1e-11);
  }
}

TEST_P(Events, ThatStopEndTheRunWhereTheyHappen) {
  const auto model = harmonic_oscillator();
  Watch watch;
  const Outcome outcome =
      run_with(GetParam(), model,
               {{"leaves", position, 0.9, Direction::down}, {"arrives", position, -0.5, Direction::down, true}}, watch);
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  EXPECT_NE(outcome.remark.find("stopped by the event 'arrives' at t = "), std::string::npos) << outcome.remark;
  EXPECT_NEAR(outcome.last.t, 2 * std::numbers::pi / 9, 0.03);  // the error of low orders
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
}  // namespace orthodyn::events_test
