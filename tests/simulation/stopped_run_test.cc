// A run that stopped in the middle is resumed, or rejected if scene, checkpoint or files have changed.
#include <fstream>
#include <map>
#include <random>

#include "lib/simulation/output/json.h"
#include "tests/simulation/resume_fixture.h"

namespace orthodyn::stopped_run_test {
namespace {

// A run that stopped at max_steps.
class Stopped : public Resume {
 protected:
  Stopped() {
    write("beam.yaml", kBeam + std::string(kBdf));
    const auto result = orthodyn("run beam.yaml --quiet --set integrator.max_steps=60");
    EXPECT_EQ(result.exit_code, 3) << result.output;
    EXPECT_NE(result.output.find("orthodyn run out/beam --resume"), std::string::npos) << result.output;
  }

  // Every file with its content.
  std::map<std::string, std::string> content() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
      if (entry.is_regular_file()) files[entry.path().string()] = read_text(entry.path());
    return files;
  }

  void expect_refused(const std::string& arguments, const std::string& words) const {
    const auto before = content();
    const auto result = orthodyn("run " + arguments + " --resume");
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.output;
    EXPECT_NE(result.output.find(words), std::string::npos) << result.output;
    EXPECT_EQ(content(), before) << arguments;
  }

  fs::path checkpoint_ = folder_ / "out/beam/checkpoint.cbor";
};

TEST_F(Stopped, ARunThatFailedForMaxStepsGoesOnWithMore) {
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --resume").exit_code, 0);
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out whole").exit_code, 0);
  EXPECT_LT(difference(folder_ / "out/beam", folder_ / "whole"), 10 * kRtol);
  expect_same_times(folder_ / "out/beam", folder_ / "whole");
}

TEST_F(Stopped, TheRecordTellsOfTheRestartAndSumsUp) {
  ASSERT_EQ(orthodyn("run out/beam --quiet --resume --set integrator.max_steps=1000").exit_code, 0);
  const auto json = record("out/beam");
  ASSERT_EQ(json.at("restarts").size(), 1u);
  EXPECT_EQ(json["restarts"][0]["after"], "failed");
  EXPECT_EQ(json["restarts"][0]["changed"], Json::array({"integrator.max_steps"}));
  EXPECT_GT(json["restarts"][0]["time"], 0);
  EXPECT_EQ(json.at("statistics").at("steps"), read_rows(folder_ / "out/beam/steps.csv").size());
}

TEST_F(Stopped, TheBalanceOfEnergyGoesOnWhereItWas) {
  const auto dissipated = [&](const char* name) { return record(name).at("energy").at("dissipated").get<double>(); };
  const double before = dissipated("out/beam");
  EXPECT_GT(before, 0);
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --resume").exit_code, 0);
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out whole").exit_code, 0);
  // The errors of 25 s are half of what a lost part would cause.
  EXPECT_NEAR(dissipated("out/beam"), dissipated("whole"), 0.5 * before);
  EXPECT_LT(record("out/beam").at("energy").at("balance_drift"),
            10 * record("whole").at("energy").at("balance_drift").get<double>());
}

TEST_F(Stopped, AnotherSceneIsRefusedByTheKeysThatDiffer) {
  expect_refused("beam.yaml --set loads.0.force.2=7 --set integrator.rtol=1e-5",
                 "loads.0.force.2, integrator.rtol differ");
  expect_refused("beam.yaml --set output.frames=10", "output.frames");
  expect_refused("beam.yaml --set damping=null", "damping");
  expect_refused("beam.yaml --integrator ida_bdf", "integrator.type");
  expect_refused("beam.yaml --set time.end=0.01", "before the checkpoint");
}

TEST_F(Stopped, ADamagedCheckpointIsRefusedAndNothingDestroyed) {
  const std::string whole = read_text(checkpoint_);
  std::mt19937 random(5);
  const auto put = [&](const std::string& text) { std::ofstream(checkpoint_, std::ios::binary) << text; };
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{10}, std::size_t{41}, std::size_t{60}, whole.size() / 2, whole.size() - 1}) {
    put(whole.substr(0, length));
    expect_refused("beam.yaml", "checkpoint.cbor: ");
  }
  for (int k = 0; k < 25; ++k) {
    std::string damaged = whole;
    damaged[random() % (k < 10 ? 42 : damaged.size())] ^= static_cast<char>(1 << random() % 8);
    put(damaged);
    expect_refused("beam.yaml", "checkpoint.cbor: ");
  }
  put(std::string(100000, '\x81'));  // arrays in arrays
  expect_refused("beam.yaml", "is not a checkpoint");
}

TEST_F(Stopped, ACheckpointOfAnotherVersionIsNamed) {
  std::string text = read_text(checkpoint_);
  const auto number = text.find("checkpoint ") + std::string("checkpoint ").size();
  text.replace(number, 3, "001");
  std::ofstream(checkpoint_, std::ios::binary) << text;
  expect_refused("beam.yaml", "version 1");
}

TEST_F(Stopped, ALostFrameOrTableIsNamedAndNothingElseTouched) {
  fs::resize_file(folder_ / "out/beam/probes.csv", 40);
  expect_refused("beam.yaml", "probes.csv: has 40 bytes");
  fs::remove(folder_ / "out/beam/frames/frame_00001.vtu");
  expect_refused("beam.yaml", "frame_00001.vtu: is missing");
}

// Every file that a resumed run continues, and every earlier frame.
TEST_F(Stopped, DamagedResultsAreNamedAndNothingElseTouched) {
  for (const char* name : {"frames/frame_00000.vtu", "frames/frame_00001.vtu", "frames.pvd", "probes.csv", "energy.csv",
                           "momentum.csv", "steps.csv"}) {
    const fs::path file = folder_ / "out/beam" / name;
    const std::string whole = read_text(file);
    const auto put = [&](const std::string& text) { std::ofstream(file, std::ios::binary) << text; };
    std::string flipped = whole;
    flipped[flipped.size() / 3] ^= 1;
    std::string digits = whole;  // still a table
    const auto digit = digits.find_first_of("0123456789", digits.size() / 2);
    digits[digit] = digits[digit] == '7' ? '8' : '7';
    for (const std::string& damaged :
         {std::string(), whole.substr(0, whole.size() / 2), flipped, digits, std::string(whole.size(), '\0')}) {
      put(damaged);
      expect_refused("beam.yaml", fs::path(name).filename().string() + ": ");
    }
    put(whole);
  }
  EXPECT_EQ(orthodyn("run beam.yaml --quiet --resume").exit_code, 0);
}

// Results later than the checkpoint are computed again.
TEST_F(Stopped, WhatFollowsTheCheckpointMayBeDamaged) {
  for (const char* name : {"probes.csv", "energy.csv", "frames.pvd"})
    std::ofstream(folder_ / "out/beam" / name, std::ios::binary | std::ios::app) << "1,2";
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --resume").exit_code, 0);
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out whole").exit_code, 0);
  expect_same_times(folder_ / "out/beam", folder_ / "whole");
}

TEST_F(Stopped, WithoutItsCheckpointItIsRefused) {
  fs::remove(checkpoint_);
  expect_refused("beam.yaml", "without a checkpoint");
}

TEST_F(Stopped, OnlyFramesOfTheRunAreRemovedWhenItGoesOn) {
  const auto frames = folder_ / "out/beam/frames";
  const std::vector<std::string> others{"frame_99999.png", "frame_99999.vtu.bak", "frame_99999.vtu.part.txt",
                                        "frame_7.vtu"};
  const std::vector<std::string> ours{"frame_99999.vtu", "frame_99998.vtu.part", "frame_00000.vtu.part",
                                      "frame_00000.vtu.123-4.part"};
  for (const auto& name : others) std::ofstream(frames / name) << "x";
  for (const auto& name : ours) std::ofstream(frames / name) << "x";
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --resume").exit_code, 0);
  for (const auto& name : others) EXPECT_TRUE(fs::exists(frames / name)) << name;
  for (const auto& name : ours) EXPECT_FALSE(fs::exists(frames / name)) << name;
}

}  // namespace
}  // namespace orthodyn::stopped_run_test
