// The time loop and its output files, on small scenes.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <thread>

#include "lib/mesh/io/mesh_file.h"
#include "lib/ode/derived_model.h"
#include "lib/scene/build.h"
#include "lib/simulation/checkpoint/checkpoint.h"
#include "lib/simulation/checkpoint/checkpointer.h"
#include "lib/simulation/output/curves.h"
#include "lib/simulation/output/frames.h"
#include "lib/simulation/run/run.h"
#include "tests/scene/scenes.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::driver_test {
namespace {

struct Recorder : Observer {
  void on_start(const ObservedState& observed) override { outputs.push_back(observed.t()); }
  void on_output(const ObservedState& observed) override { outputs.push_back(observed.t()); }
  void on_history(const ObservedState& observed) override { history.push_back(observed.t()); }
  void on_step(const StepInfo& info, const ObservedState&, const Integrator&) override { steps.push_back(info.t); }
  void on_end() noexcept override { ++ends; }
  std::vector<double> outputs, history, steps;
  int ends = 0;
};

struct Case {
  explicit Case(const std::string& yaml)
      : scene(read_scene(Config::from_text(yaml))),
        built(build(scene)),
        integrator(scene.integrator->make(*built.model, {[] {
                                                           return Scales{0.1, 1};
                                                         },
                                                         built.initial, scene.time.end, 0})) {}
  Outcome run_with(Plan plan, std::vector<Observer*> observers) {
    plan.end = scene.time.end;
    return run(*built.model, *integrator, built.initial, plan, observers, never);
  }
  Scene scene;
  BuiltScene built;
  std::unique_ptr<Integrator> integrator;
  std::atomic<bool> never{false};
};

TEST(OutputTimes, CoverTheSpanEvenlyAndEndOnIt) {
  EXPECT_EQ(evenly_spaced(0, 1, 4), (std::vector<double>{0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(by_interval(0, 1, 0.4), (std::vector<double>{0.4, 0.8, 1}));
  EXPECT_EQ(by_interval(0, 0.3, 0.1).size(), 3u);  // no doubled end from rounding
  EXPECT_TRUE(evenly_spaced(0, 1, 0).empty());
}

// For any start, and for ends reached with and without round-off.
TEST(OutputTimes, ByIntervalNeverComeTwice) {
  for (const double start : {0.0, 1e-3, -1.0, 7.0, 1e3, 1e6, -1e6, 1e8})
    for (const double interval : {1e-2, 0.1, 0.3, 1.0 / 3, 7e-3})
      for (const int count : {1, 2, 3, 7, 10, 33, 100}) {
        const double end = start + count * interval;
        const auto times = by_interval(start, end, interval);
        ASSERT_EQ(times.size(), static_cast<std::size_t>(count)) << start << " " << interval;
        EXPECT_EQ(times.back(), end);
        double before = start;
        for (const double t : times) {
          EXPECT_NEAR(t - before, interval, 1e-2 * interval) << start;
          before = t;
        }
      }
}

TEST(Driver, DeliversEveryOutputOnceAtLateTimes) {
  for (const double start : {0.0, 1e3, 1e6}) {
    std::string yaml = kSwing;
    yaml.replace(yaml.find("{end: 0.5}"), 10, fmt::format("{{start: {}, end: {}}}", start, start + 0.1));
    Case swing(yaml);
    Recorder seen;
    swing.run_with(
        {.output_times = by_interval(start, start + 0.1, 1e-2), .history_times = by_interval(start, start + 0.1, 1e-2)},
        {&seen});
    EXPECT_EQ(seen.outputs.size(), 11u);  // with the start
    EXPECT_EQ(seen.history.size(), 10u);
    EXPECT_EQ(std::adjacent_find(seen.outputs.begin(), seen.outputs.end()), seen.outputs.end());
  }
}

TEST(Driver, DeliversEveryOutputOnceAndInOrder) {
  for (const bool exact : {false, true}) {
    Case swing(kSwing);
    Recorder seen;
    const Plan plan{0, evenly_spaced(0, 0.5, 37), exact};
    EXPECT_EQ(swing.run_with(plan, {&seen}).status, Outcome::Status::completed);
    ASSERT_EQ(seen.outputs.size(), 38u);
    for (std::size_t k = 0; k < 37; ++k) EXPECT_EQ(seen.outputs[k + 1], plan.output_times[k]);
    EXPECT_EQ(seen.ends, 1);
    for (const double t : plan.output_times)
      EXPECT_TRUE(!exact || std::find(seen.steps.begin(), seen.steps.end(), t) != seen.steps.end()) << t;
  }
}

TEST(Driver, DeliversTheHistoryApartFromTheOutputs) {
  Case swing(kSwing);
  Recorder with_outputs, apart, at_steps;
  swing.run_with({.output_times = evenly_spaced(0, 0.5, 5)}, {&with_outputs});
  EXPECT_EQ(with_outputs.history, std::vector(with_outputs.outputs.begin() + 1, with_outputs.outputs.end()));
  swing.run_with({.output_times = evenly_spaced(0, 0.5, 5), .history_times = by_interval(0, 0.5, 0.03)}, {&apart});
  EXPECT_EQ(apart.outputs.size(), 6u);
  EXPECT_EQ(apart.history, by_interval(0, 0.5, 0.03));
  swing.run_with({.output_times = evenly_spaced(0, 0.5, 5), .history_at_steps = true}, {&at_steps});
  EXPECT_EQ(at_steps.history, at_steps.steps);
  EXPECT_EQ(at_steps.outputs.size(), 6u);
}

TEST(Driver, NeverStepsAcrossAKinkOfTheLoads) {
  Case swing(std::string(kSwing) +
             "loads: [{surface: x1, force: [0, 1, 0], factor: {type: ramp, start: 0.1, end: 0.2}}]\n");
  Recorder seen;
  EXPECT_EQ(swing.run_with({}, {&seen}).status, Outcome::Status::completed);
  for (const double kink : {0.1, 0.2})
    EXPECT_NE(std::find(seen.steps.begin(), seen.steps.end(), kink), seen.steps.end()) << kink;
}

TEST(Driver, TakesTimesThatDifferByRoundOffForOne) {
  for (const char* type : {"cvode_bdf", "ida_bdf"}) {
    Case swing(std::string(kSwing).replace(std::string(kSwing).find("cvode_bdf"), 9, type) +
               "loads:\n- {surface: x1, force: [0, 1, 0], factor: {type: ramp, end: 0.3}}\n"
               "- {surface: x1, force: [0, 1, 0], factor: {type: ramp, end: 0.30000000000000004}}\n");
    Recorder seen;
    const auto outcome = swing.run_with({0, by_interval(0, 0.5, 0.1), true}, {&seen});
    EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
    EXPECT_EQ(seen.outputs.size(), 6u);
  }
}

// A model that allows steps of 1e-4 s up to the time 0.02 s, and any steps afterwards.
class ShortSteps : public DerivedModel {
 public:
  static constexpr double kLongest = 1e-4, kUntil = 0.02;
  explicit ShortSteps(const Model& original) : DerivedModel(original) {}
  const Traits& traits() const override { return original().traits(); }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    original().force(t, q, v, f);
  }
  double longest_step(const State& state) const override {
    return state.t < kUntil ? kLongest : std::numeric_limits<double>::infinity();
  }
  std::vector<OutputInfo> outputs() const override { return original().outputs(); }
  std::unique_ptr<StateView> view(const State& state) const override { return original().view(state); }
  Geometry geometry() const override { return original().geometry(); }

 private:
  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override {
    original().linearize(t, q, v, kind, out);
  }
};

TEST(Driver, TakesNoStepThatMayMissAContact) {
  for (const char* type : {"cvode_bdf", "ida_bdf", "sdirk"}) {
    Case swing(std::string(kSwing).replace(std::string(kSwing).find("cvode_bdf"), 9, type));
    const ShortSteps model(*swing.built.model);
    Recorder seen;
    Plan plan;
    plan.end = swing.scene.time.end;
    const Outcome outcome = run(model, *swing.integrator, swing.built.initial, plan, {&seen}, swing.never);
    ASSERT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
    double before = 0, longest = 0, longest_after = 0;
    for (const double t : seen.steps) {
      double& largest = before < ShortSteps::kUntil ? longest : longest_after;
      largest = std::max(largest, t - before);
      before = t;
    }
    EXPECT_LE(longest, ShortSteps::kLongest * (1 + 1e-9)) << type;
    EXPECT_GT(longest_after, 3 * ShortSteps::kLongest) << type;  // steps grow again
    EXPECT_FALSE(outcome.may_pass_through) << type;
  }
}

TEST(Driver, TurnsAFailureIntoAnOutcomeThatKeepsTheLastState) {
  Case swing(kSwing + std::string("mass: lumped\n"));
  struct Fails : Observer {
    void on_step(const StepInfo& info, const ObservedState&, const Integrator&) override {
      if (info.t > 0.1) throw RunError("no space left", Reason::diverged);
    }
  } fails;
  Recorder seen;
  const auto outcome = swing.run_with({}, {&seen, &fails});
  EXPECT_EQ(outcome.status, Outcome::Status::failed);
  EXPECT_EQ(outcome.message, "no space left");
  EXPECT_EQ(outcome.reason, Reason::diverged);
  EXPECT_EQ(seen.ends, 1);
  EXPECT_GT(outcome.last.t, 0.1);
}

TEST(Driver, TurnsALackOfMemoryIntoAnOutcomeThatSaysSo) {
  Case swing(kSwing + std::string("mass: lumped\n"));
  struct Fails : Observer {
    void on_step(const StepInfo&, const ObservedState&, const Integrator&) override { throw std::bad_alloc(); }
  } fails;
  const auto outcome = swing.run_with({}, {&fails});
  EXPECT_EQ(outcome.status, Outcome::Status::failed);
  EXPECT_STREQ(reason_name(outcome.reason), "out of memory");
}

// Processor time of this thread, s.
double thread_seconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Another run in this process works ten times as long.
TEST(Outcomes, ARunIsToldItsOwnProcessorTime) {
  constexpr double kOwn = 0.05, kNeighbours = 0.5;  // s
  const auto work_for = [](double seconds) {
    const double end = thread_seconds() + seconds;
    while (thread_seconds() < end) {
    }
  };
  std::thread neighbour([&] { work_for(kNeighbours); });
  const auto outcome = supervise({}, {}, [&](Outcome&) {
    work_for(kOwn);
    neighbour.join();
  });
  EXPECT_GE(outcome.cpu_seconds, kOwn);
  EXPECT_LT(outcome.cpu_seconds, kNeighbours);
}

class Files : public InFolder {};

TEST_F(Files, FrameZeroIsTheInitialStateAndTimesAreReal) {
  Case swing(kSwing);
  FrameWriter frames(folder_, *swing.built.model, {"displacement", "stress"});
  ASSERT_EQ(swing.run_with({0, {0.125, 0.5}, false}, {&frames}).status, Outcome::Status::completed);
  const auto pvd = read_text(folder_ / "frames.pvd");
  for (const char* entry :
       {"timestep=\"0\" part=\"0\" file=\"frames/frame_00000.vtu\"", "timestep=\"0.125\"", "timestep=\"0.5\""})
    EXPECT_NE(pvd.find(entry), std::string::npos) << entry;
}

TEST_F(Files, FramesCarryTheNamesOfRegions) {
  Case two(replaced(kSwing, "cells: [4, 1, 1], order: 1}",
                    "cells: [4, 1, 1], order: 1, parts: {stiff: {min: [0, 0, 0], max: [0.5, 1, 1]}}}"));
  const Mesh& mesh = two.built.model->parts().mesh;
  ASSERT_EQ(mesh.region_names.size(), 2u);
  for (const std::vector<std::string>& fields :
       {std::vector<std::string>{"displacement"}, {"displacement", "region"}}) {
    FrameWriter frames(folder_, *two.built.model, fields, &mesh);
    frames.on_start({*two.built.model, two.built.initial});
    const Mesh read = read_mesh((folder_ / "frames/frame_00000.vtu").string()).mesh;
    ASSERT_EQ(read.region_of.size(), mesh.region_of.size());
    for (std::size_t e = 0; e < mesh.region_of.size(); ++e)
      EXPECT_EQ(read.region_names[static_cast<std::size_t>(read.region_of[e])],
                mesh.region_names[static_cast<std::size_t>(mesh.region_of[e])]);
  }
}

TEST_F(Files, AVtuHoldsAsManyBytesAsItsOffsetsSay) {
  Case swing(kSwing);
  FrameWriter frames(folder_, *swing.built.model, {"displacement", "velocity", "det_f", "stress_material", "region"});
  frames.on_start({*swing.built.model, swing.built.initial});
  const auto text = read_text(folder_ / "frames/frame_00000.vtu");
  const auto base = text.find("<AppendedData encoding=\"raw\">\n_") + 31;
  ASSERT_NE(base, std::string::npos + 31);
  std::size_t expected = 0;
  for (std::size_t at = text.find("offset=\""); at < base && at != std::string::npos;
       at = text.find("offset=\"", at + 1)) {
    EXPECT_EQ(std::stoul(text.substr(at + 8)), expected);
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, text.data() + base + expected, sizeof bytes);
    expected += sizeof bytes + bytes;
  }
  EXPECT_EQ(text.substr(base + expected), "\n</AppendedData>\n</VTKFile>\n");
}

TEST_F(Files, AGrowingFileIsWholeAfterEachEntryAndCanBeCutBack) {
  GrowingFile file(folder_ / "list", "<a>\n", "</a>\n");
  file.begin();
  EXPECT_EQ(read_text(folder_ / "list"), "<a>\n</a>\n");
  file.append("first\n");
  Archive after_first;
  file.save(after_first);
  file.append("a longer second entry\n");
  EXPECT_EQ(read_text(folder_ / "list"), "<a>\nfirst\na longer second entry\n</a>\n");
  GrowingFile again(folder_ / "list", "<a>\n", "</a>\n");
  again.restore(after_first);
  again.reopen();
  EXPECT_EQ(read_text(folder_ / "list"), "<a>\nfirst\n</a>\n");
  again.append("2\n");
  EXPECT_EQ(read_text(folder_ / "list"), "<a>\nfirst\n2\n</a>\n");
  std::ofstream(folder_ / "list") << "<a>\nfirsT\n</a>\n";
  EXPECT_THROW(again.restore(after_first), ConfigError);
  std::ofstream(folder_ / "list") << "<a>\n";
  EXPECT_THROW(again.restore(after_first), ConfigError);
}

TEST_F(Files, ACheckpointComesBackBitByBit) {
  Checkpoint written;
  written.scene = "time: {end: 1}\n";
  written.begun = true;
  written.state = {0.1, Vector::Random(50) * 1e-300, Vector::Random(50)};
  written.state.v[3] = std::numeric_limits<double>::infinity();
  written.state.lambda = Vector::Random(3);
  written.state.angles = Vector::Random(2);
  written.schedule = {0, 1.0 / 3, 1e-9};
  written.cost.statistics.newton_iterations = 123456789;
  written.cost.statistics.solve = {7, 0.3};
  written.restarts = {{0.05, "2026-01-31T12:00:00Z", "killed", {"time.end"}}};
  written.observers["energy"].put("last", {0.1, -2e300, 5});
  written.save(folder_ / "c");
  const auto read = Checkpoint::load(folder_ / "c");
  EXPECT_EQ(read.scene, written.scene);
  EXPECT_EQ(read.state.t, written.state.t);
  EXPECT_EQ(read.state.q, written.state.q);
  EXPECT_EQ(read.state.v, written.state.v);
  EXPECT_EQ(read.state.lambda, written.state.lambda);
  EXPECT_EQ(read.state.angles, written.state.angles);
  EXPECT_EQ(read.schedule.end, written.schedule.end);
  EXPECT_EQ(read.cost.statistics.newton_iterations, 123456789);
  EXPECT_EQ(read.cost.statistics.solve.seconds, 0.3);
  EXPECT_EQ(read.restarts.at(0).changed, written.restarts[0].changed);
  EXPECT_EQ(read.observers.at("energy").numbers("last", 3), (std::vector<double>{0.1, -2e300, 5}));
  EXPECT_THROW(read.observers.at("energy").number("last"), ConfigError);
}

TEST_F(Files, TheEnergyBalanceClosesAsTheToleranceFalls) {
  const auto drift = [&](const char* rtol) {
    Case swing(std::string(kSwing).replace(std::string(kSwing).find("1e-3"), 4, rtol) +
               "loads: [{surface: x1, force: [0, 2, 0], factor: {type: sine, frequency: 3}}]\n");
    EnergyWriter energy(folder_ / "energy.csv", *swing.built.model, *swing.integrator, EnergyTimes::outputs);
    swing.run_with({0, evenly_spaced(0, 0.5, 10), false}, {&energy});
    EXPECT_GT(energy.last().dissipated, 0);
    EXPECT_NE(energy.last().loads, 0);
    return energy.drift() / energy.scale();
  };
  const double loose = drift("1e-4"), tight = drift("1e-7");
  EXPECT_LT(loose, 1e-2);
  EXPECT_LT(tight, loose / 30);
}

// An observer that is slow to save, as for a large model on a slow disk.
struct SlowKeeper : Observer {
  void save(Archive&) override {
    ++saved;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  int saved = 0;
};

class CheckpointTime : public InFolder {};

TEST_F(CheckpointTime, IsSpentOnATenthOfTheRunAtMost) {
  Case swing(kSwing);
  SlowKeeper slow;
  Checkpointer checkpointer(folder_ / "checkpoint.cbor", {}, {.every = 1e-9}, {{"slow", &slow}}, *swing.built.model,
                            *swing.integrator);
  const ObservedState initial(*swing.built.model, swing.built.initial);
  checkpointer.on_start(initial);
  for (int step = 0; step < 5; ++step) checkpointer.on_step({}, initial, *swing.integrator);
  EXPECT_EQ(slow.saved, 1);
}

}  // namespace
}  // namespace orthodyn::driver_test
