// A single changed bit in files that are read back: a run rejects the file by name, a study repeats the work; neither
// uses the damaged data. Checkpoints: tests/simulation/stopped_run_test.cc.
#include <fmt/format.h>

#include <fstream>
#include <functional>
#include <random>
#include <set>

#include "tests/simulation/resume_fixture.h"
#include "tests/study/sweep_command.h"

namespace orthodyn::flipped_bits_test {
namespace {

// Restores the file on destruction.
class FlippedBit {
 public:
  FlippedBit(const fs::path& file, std::mt19937& random) : file_(file), whole_(read_text(file)) {
    std::string damaged = whole_;
    at_ = random() % damaged.size();
    bit_ = random() % 8;
    damaged[at_] ^= static_cast<char>(1 << bit_);
    std::ofstream(file, std::ios::binary) << damaged;
  }
  ~FlippedBit() { std::ofstream(file_, std::ios::binary) << whole_; }
  FlippedBit(const FlippedBit&) = delete;
  FlippedBit& operator=(const FlippedBit&) = delete;

  std::string text() const { return fmt::format("bit {} of byte {} of {}", bit_, at_, file_.string()); }

 private:
  fs::path file_;
  std::string whole_;
  std::size_t at_ = 0, bit_ = 0;
};

const char* const kOneStep = R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [2, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
clamps: [{surface: x0}]
gravity: [0, 0, -1]
time: {end: 0.1}
integrator: {type: arkode_dirk, step: 0.02, rtol: 1e-10}
output: {frames: 5}
)";

class FlippedBitsOfARun : public Resume {};

// The scene beside a checkpoint is compared with the one inside; permitted changes are reported.
TEST_F(FlippedBitsOfARun, TheSceneBesideACheckpoint) {
  write("beam.yaml", kOneStep + std::string("checkpoint: {frames: 1}\n"));
  ASSERT_EQ(orthodyn("run beam.yaml --quiet").exit_code, 0);
  const std::string record = read_text(folder_ / "out/beam/run.json");
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 60; ++i) {
    fs::remove_all(folder_ / "copy");
    fs::copy(folder_ / "out/beam", folder_ / "copy", fs::copy_options::recursive);
    const FlippedBit flipped(folder_ / "copy/scene.yaml", random);
    const auto result = orthodyn("run copy --resume");
    if (result.exit_code == 0) {
      EXPECT_TRUE(result.output.find("is complete") != std::string::npos ||
                  result.output.find("changed since the checkpoint: ") != std::string::npos)
          << flipped.text() << "\n"
          << result.output;
      continue;
    }
    ++refused;
    EXPECT_EQ(result.exit_code, 2) << flipped.text() << "\n" << result.output;
    EXPECT_NE(result.output.find("copy/"), std::string::npos) << flipped.text() << "\n" << result.output;
    EXPECT_EQ(read_text(folder_ / "copy/run.json"), record) << flipped.text();
  }
  EXPECT_GT(refused, 20);
}

// A completed run is not mistaken for another one.
TEST_F(FlippedBitsOfARun, TheSceneAndTheRecordOfACompletedRun) {
  write("beam.yaml", kOneStep);
  ASSERT_EQ(orthodyn("run beam.yaml --quiet").exit_code, 0);
  std::mt19937 random(8);
  for (const char* name : {"scene.yaml", "run.json"}) {
    const std::string frame = read_text(folder_ / "out/beam/frames/frame_00005.vtu");
    for (int i = 0; i < 40; ++i) {
      const FlippedBit flipped(folder_ / "out/beam" / name, random);
      const auto result = orthodyn("run beam.yaml --resume");
      EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 2) << flipped.text() << "\n" << result.output;
      EXPECT_NE(result.output.find(result.exit_code == 0 ? "is complete at t = 0.1 s" : "out/beam"), std::string::npos)
          << flipped.text() << "\n"
          << result.output;
      EXPECT_EQ(read_text(folder_ / "out/beam/frames/frame_00005.vtu"), frame);
    }
  }
}

class FlippedBitsOfAStudy : public InFolder {
 protected:
  FlippedBitsOfAStudy() { write("scene.yaml", kOscillator); }

  std::vector<fs::path> files(const std::string& name) const {
    std::set<fs::path> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
      if (entry.path().filename() == name) all.insert(entry.path());
    return {all.begin(), all.end()};
  }
  // The values of a table; times and memory vary.
  static Json points(const fs::path& table, const char* key) {
    Json all = Json::parse(read_text(table)).at(key);
    for (auto& point : all)
      for (const char* other : {"cost", "wall", "cpu", "statistics", "peak_memory_bytes", "at"}) point.erase(other);
    return all;
  }

  // Compared as JSON: 1e-05 and 1E-05 differ by a bit.
  static bool says_the_same_as(const std::string& before, const std::string& after) {
    const Json a = Json::parse(before, nullptr, false), b = Json::parse(after, nullptr, false);
    return !a.is_discarded() && a == b;
  }

  // `names`: the file in the warning.
  void expect_done_again(const std::string& command, const std::string& file, const fs::path& table, const char* key,
                         const std::function<std::string(const fs::path&)>& names) {
    ASSERT_EQ(orthodyn(command).exit_code, 0);
    const Json whole = points(folder_ / table, key);
    const auto all = files(file);
    ASSERT_FALSE(all.empty());
    std::mt19937 random(9);
    for (int i = 0; i < 40; ++i) {
      const fs::path& one = all[random() % all.size()];
      const std::string whole_file = read_text(one);
      const FlippedBit flipped(one, random);
      const bool says_the_same = says_the_same_as(whole_file, read_text(one));
      const auto result = orthodyn(command);
      EXPECT_EQ(result.exit_code, 0) << flipped.text() << "\n" << result.output;
      const bool is_done_again =
          result.output.find(fmt::format("warning: {} is damaged", names(one))) != std::string::npos;
      EXPECT_NE(is_done_again, says_the_same) << flipped.text() << "\n" << result.output;
      EXPECT_EQ(points(folder_ / table, key), whole) << flipped.text() << "\n" << result.output;
    }
  }
  std::string relative(const fs::path& path) const { return path.lexically_relative(folder_).string(); }
};

TEST_F(FlippedBitsOfAStudy, ResultsOfASweep) {
  write("s.yaml",
        "scene: scene.yaml\nvary: {materials.soft.young: [1e5, 2e5]}\n"
        "quantities: {far: {quantity: node.displacement.x, take: max}}\n");
  expect_done_again("sweep s.yaml --no-report --jobs 1", "result.json", "out/sweeps/s/sweep.json", "points",
                    [&](const fs::path& file) { return relative(file); });
}

class FlippedBitsOfAComparison : public FlippedBitsOfAStudy {
 protected:
  FlippedBitsOfAComparison() {
    write("c.yaml",
          "scenes: [scene.yaml]\nintegrators: [{type: tr_bdf2}]\ntolerances: [1e-3]\nrepeats: 1\nsamples: 4\n"
          "reference: {kind: computed, integrator: {type: ida_bdf, max_order: 5, rtol: 1e-6}, check: {type: cvode_bdf, "
          "max_order: 5, rtol: 1e-6}}\n");
  }
};

TEST_F(FlippedBitsOfAComparison, ResultsAndReferences) {
  expect_done_again("compare c.yaml --no-report", "result.json", "out/comparisons/c/compare.json", "points",
                    [&](const fs::path& file) { return relative(file); });
}

TEST_F(FlippedBitsOfAComparison, TrajectoriesOfReferences) {
  expect_done_again("compare c.yaml --no-report", "trajectory.bin", "out/comparisons/c/compare.json", "points",
                    [&](const fs::path& file) { return relative(file.parent_path()); });
}

TEST_F(FlippedBitsOfAStudy, ResultsOfAMatrix) {
  write("case.yaml", std::string(kOscillator) +
                         "expect: [{quantity: node.displacement.x, take: max, value: 2e-5, source: a formula, "
                         "relative: 1, reason: none}]\n");
  write("m.yaml", "cases: [case.yaml]\nintegrators: [tr_bdf2, newmark]\n");
  expect_done_again("stability m.yaml --no-report --quiet --jobs 1", "result.json", "out/stability/m/stability.json",
                    "trials", [&](const fs::path& file) { return relative(file); });
}

}  // namespace
}  // namespace orthodyn::flipped_bits_test
