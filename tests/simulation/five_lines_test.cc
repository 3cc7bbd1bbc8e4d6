// A scene run by the library alone, from C++, gives the results of `orthodyn run`.
#include <nlohmann/json.hpp>

#include "lib/simulation/simulation.h"
#include "tests/simulation/result_reader.h"

namespace orthodyn::five_lines_test {
namespace {

using FiveLines = InFolder;
using Status = Outcome::Status;

class Listener : public RunListener {
 public:
  void on_warning(const std::string& text) override { warnings.push_back(text); }
  void on_notice(const std::string& text) override { notices.push_back(text); }
  std::unique_ptr<Observer> on_begin(const Setup&) override { return ++begun, nullptr; }
  void on_result(const RunResult& result) override { results.push_back(result.outcome.status); }

  std::vector<std::string> warnings, notices;
  std::vector<Status> results;
  int begun = 0;
};

TEST_F(FiveLines, ASceneRunsWithItsOutputsAndGoesOn) {
  const std::string scene = write("swing.yaml", std::string(kSwing) + "checkpoint: {}\n").string();
  const fs::path out = folder_ / "out";

  const RunResult half = Simulation::from_file(scene, {.set = {"time.end=0.2"}}).run({.folder = out});
  const RunResult whole = Simulation::from_file(scene).run({.folder = out, .resume = true});

  EXPECT_EQ(half.outcome.status, Status::completed);
  EXPECT_EQ(half.outcome.last.t, 0.2);
  EXPECT_EQ(whole.outcome.status, Status::completed);
  EXPECT_EQ(whole.outcome.last.t, 0.5);
  EXPECT_GT(whole.motion->cost.statistics.steps, half.motion->cost.statistics.steps);
  for (const char* name : {"frames.pvd", "probes.csv", "energy.csv", "scene.yaml", "checkpoint.cbor"})
    EXPECT_TRUE(fs::exists(out / name)) << name;
  const auto rows = read_rows(out / "energy.csv");
  EXPECT_EQ(rows.front()[0], 0);
  EXPECT_EQ(rows.back()[0], 0.5);
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_GT(rows[i][0], rows[i - 1][0]);
  const auto record = nlohmann::json::parse(read_text(out / "run.json"));
  EXPECT_EQ(record.at("status"), "completed");
  ASSERT_EQ(record.at("restarts").size(), 1u);
  EXPECT_EQ(record.at("restarts")[0].at("changed"), nlohmann::json({"time.end"}));
}

TEST_F(FiveLines, ItIsWhatTheProgramDoes) {
  const std::string scene = write("swing.yaml", kSwing).string();
  Simulation::from_file(scene).run({.folder = folder_ / "library"});
  ASSERT_EQ(orthodyn("run swing.yaml --quiet --out program").exit_code, 0);
  for (const char* name : {"frames.pvd", "probes.csv", "energy.csv"})
    EXPECT_EQ(read_text(folder_ / "library" / name), read_text(folder_ / "program" / name)) << name;
}

TEST_F(FiveLines, AnInterruptedRunIsAResultAndGoesOn) {
  const auto simulation = Simulation::from_file(write("swing.yaml", kSwing).string());
  const std::atomic<bool> interrupt{true};
  const RunResult interrupted = simulation.run({.folder = folder_ / "out"}, interrupt);
  EXPECT_EQ(interrupted.outcome.status, Status::interrupted);
  EXPECT_TRUE(interrupted.resumable);
  const RunResult rest = simulation.run({.folder = folder_ / "out", .resume = true});
  EXPECT_EQ(rest.outcome.status, Status::completed);
  EXPECT_EQ(rest.outcome.last.t, 0.5);
}

TEST_F(FiveLines, ItTellsTheListenerAndPrintsNothing) {
  const auto simulation = Simulation::from_file(write("swing.yaml", kSwing).string());
  const std::atomic<bool> never{false};
  Listener listener;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const RunResult result =
      simulation.run({.folder = folder_ / "out", .resume = true, .estimate_error = true}, never, listener);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  ASSERT_EQ(listener.notices.size(), 2u);
  EXPECT_NE(listener.notices[0].find("nothing to resume"), std::string::npos);
  EXPECT_NE(listener.notices[1].find("integrator.rtol=0.0001"), std::string::npos);
  EXPECT_EQ(listener.begun, 2);  // the run, and once more for its error
  EXPECT_EQ(listener.results, std::vector{Status::completed});
  ASSERT_TRUE(result.motion && result.motion->error);
  EXPECT_TRUE(result.motion->error->completed);
}

TEST_F(FiveLines, AStaticSceneHasAnEquilibriumInPlaceOfAMotion) {
  const auto scene = write("bar.yaml", R"(analysis: static
mesh: {type: box, size: [1, 0.2, 0.1], cells: [4, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
clamps: [{surface: x0}]
loads: [{surface: x1, traction: [1e5, 0, 0]}]
)");
  const RunResult result = Simulation::from_file(scene.string()).run({.folder = folder_ / "out"});
  EXPECT_EQ(result.outcome.status, Status::completed);
  EXPECT_EQ(result.outcome.last.t, 1);  // the load factor
  EXPECT_FALSE(result.motion);
  ASSERT_TRUE(result.equilibrium);
  EXPECT_NEAR(result.equilibrium->largest_displacement, 0.1, 1e-6);  // traction / young x length
  EXPECT_TRUE(fs::exists(folder_ / "out/load_steps.csv"));
}

TEST_F(FiveLines, AnEarlierResultIsNotTouched) {
  const auto simulation = Simulation::from_file(write("swing.yaml", kSwing).string());
  simulation.run({.folder = folder_ / "out"});
  const std::string before = read_text(folder_ / "out/run.json");
  EXPECT_THROW(simulation.run({.folder = folder_ / "out"}), ConfigError);
  EXPECT_EQ(read_text(folder_ / "out/run.json"), before);
  EXPECT_EQ(simulation.run({.folder = folder_ / "out", .force = true}).outcome.status, Status::completed);
}

TEST_F(FiveLines, WhatIsNoSceneIsRefusedAtOnce) {
  EXPECT_THROW(Simulation::from_file((folder_ / "missing.yaml").string()), ConfigError);
  EXPECT_THROW(Simulation::from_file(write("sweep.yaml", "quantities: {}\n").string()), ConfigError);
  EXPECT_THROW(Simulation::from_file(write("swing.yaml", kSwing).string(), {.set = {"no assignment"}}), ConfigError);
}

}  // namespace
}  // namespace orthodyn::five_lines_test
