// Times at which given functions of time pass values.
#include "lib/simulation/output/event_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/core/errors.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::event_finder_test {
namespace {

using Course = std::function<double(double)>;

const OutputSource kNoOutputs;

double first(const ObservedState& observed) { return observed.state().q[0]; }

State at(const Course& course, double t) { return {t, Vector::Constant(1, course(t)), Vector::Zero(1)}; }

// All crossings for steps of a given length, from t = 0.
std::vector<Crossing> crossings(EventFinder& finder, const Course& course, double step, int steps) {
  std::vector<Crossing> all;
  const State initial = at(course, 0);
  finder.start({kNoOutputs, initial});
  for (int k = 0; k < steps; ++k)
    for (auto& c :
         finder.find(k * step, (k + 1) * step, kNoOutputs, [&](double t, State&out) { out = at(course, t); })) {
      all.push_back(c);
      if (c.event->stops) return all;
    }
  return all;
}

Event event(double value, Direction direction = Direction::both, bool stops = false) {
  return {"e", first, value, direction, stops};
}

double wave(double t) { return std::cos(t); }

TEST(EventFinder, FindsTheTimesToATenBillionthOfTheStep) {
  EventFinder finder({event(0.3)});
  const double step = 0.7;
  const auto found = crossings(finder, wave, step, 18);
  const double down = std::acos(0.3), up = 2 * std::numbers::pi - down;
  const double expected[] = {down, up, down + 2 * std::numbers::pi, up + 2 * std::numbers::pi};
  ASSERT_EQ(found.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(found[k].state.t, expected[k], 1e-10 * step);
    EXPECT_EQ(found[k].upward, k % 2 == 1);
  }
}

TEST(EventFinder, TellsUpFromDown) {
  EventFinder up({event(0, Direction::up)}), down({event(0, Direction::down)});
  const auto risen = crossings(up, wave, 0.9, 14), fallen = crossings(down, wave, 0.9, 14);
  ASSERT_EQ(risen.size(), 2u);
  ASSERT_EQ(fallen.size(), 2u);
  EXPECT_NEAR(risen[0].state.t, 1.5 * std::numbers::pi, 1e-10);
  EXPECT_NEAR(fallen[0].state.t, 0.5 * std::numbers::pi, 1e-10);
}

TEST(EventFinder, FindsSeveralInOneStepInTheOrderOfTime) {
  EventFinder finder({event(-0.5), event(0.5)});
  const auto found = crossings(finder, wave, 2 * std::numbers::pi, 1);
  ASSERT_EQ(found.size(), 4u);
  constexpr int thirds[] = {1, 2, 4, 5};  // of half a period
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found[k].state.t, std::numbers::pi * thirds[k] / 3, 1e-9);
}

TEST(EventFinder, ForgetsWhatComesAfterAStop) {
  EventFinder finder({event(-0.5), event(0.5, Direction::both, true)});
  const auto found = crossings(finder, wave, 2 * std::numbers::pi, 1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].event->value, 0.5);
}

TEST(EventFinder, SeesNoEventWhereTheStartHasTheValue) {
  EventFinder exactly({event(1)});
  EXPECT_TRUE(crossings(exactly, wave, 0.5, 6).empty());
  EventFinder nearly({event(1.3)});  // but for round-off
  EXPECT_TRUE(crossings(
                  nearly, [](double t) { return 1.3 * (1 + 4e-16) - t; }, 0.1, 10)
                  .empty());
}

TEST(EventFinder, SeesTheValueReachedExactlyAtTheEndOfAStepOnce) {
  EventFinder finder({event(2)});
  const auto found = crossings(
      finder, [](double t) { return t; }, 1, 5);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].state.t, 2);
  EXPECT_TRUE(found[0].upward);
}

TEST(EventFinder, RemembersTheSideAcrossACheckpoint) {
  EventFinder before({event(1)}), after({event(1)});
  const State initial = at([](double t) { return t; }, 0.5);
  before.start({kNoOutputs, initial});
  Archive archive;
  before.save(archive);
  after.restore(archive);
  const auto found =
      after.find(0.9, 1.1, kNoOutputs, [](double t, State& out) { out = at([](double s) { return s; }, t); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].state.t, 1, 1e-15);
}

TEST(EventFinder, SaysWhichQuantityIsNotFinite) {
  EventFinder finder({event(1)});
  try {
    crossings(
        finder, [](double t) { return t < 1 ? 0 : std::nan(""); }, 0.5, 5);
    ADD_FAILURE() << "no error";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("event 'e' at t = 1"), std::string::npos) << e.what();
  }
}

TEST(Events, ThatNeverHappenedAreNamed) {
  const auto wave = [](double t) { return std::sin(t); };
  EventFinder finder({{"middle", first, 0.5}, {"top", first, 1.5}});
  EXPECT_EQ(finder.not_found(), (std::vector<std::string>{"middle", "top"}));
  crossings(finder, wave, 0.1, 30);
  EXPECT_EQ(finder.not_found(), std::vector<std::string>{"top"});
  Archive archive;
  finder.save(archive);
  EventFinder later({{"middle", first, 0.5}, {"top", first, 1.5}});
  later.restore(archive);
  EXPECT_EQ(later.not_found(), std::vector<std::string>{"top"});
}

using SilentEvents = InFolder;

TEST_F(SilentEvents, AreNamedInTheSummary) {
  write("swing.yaml", std::string(kSwing) + "events: [{quantity: tip.displacement.z, crosses: 5, name: landing}]\n");
  const auto result = orthodyn("run swing.yaml");
  EXPECT_NE(result.output.find("events          never happened: landing"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace orthodyn::event_finder_test
