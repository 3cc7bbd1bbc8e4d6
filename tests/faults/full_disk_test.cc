// Each write of a run and of a study fails once, and from each write on the disk is full: the program names the file
// and the reason, earlier files remain, and the same command completes with the same result once there is space.
#include <fmt/format.h>

#include <map>

#include "lib/simulation/output/json.h"
#include "tests/faults/faulty_program.h"
#include "tests/simulation/run_program.h"
#include "tests/study/sweep_command.h"

namespace orthodyn::full_disk_test {
namespace {

using Kind = WriteFaults::Kind;

struct FaultyDisk {
  const char* name;
  Kind kind;
  const char* reason;  // of the system
};

class OnFaultyDisk : public testing::WithParamInterface<FaultyDisk>, public FaultyProgram {
 protected:
  // The k-th write fails.
  Result orthodyn_failing(long k, const std::string& arguments) const {
    return orthodyn_with_fault(GetParam().kind, k, arguments);
  }

  // Calls `expect` with the result of the command for each k.
  template <class Prepare, class Expect>
  void for_each_write(const std::string& command, Prepare&& prepare, Expect&& expect) {
    for (long k = 1;; ++k) {
      SCOPED_TRACE(fmt::format("write {}", k));
      prepare();
      const auto result = orthodyn_failing(k, command);
      if (result.writes < k) {  // there are not as many
        EXPECT_GT(k, 10);
        return;
      }
      expect(result);
      if (HasFailure()) return;
    }
  }

  // "... out/beam/energy.csv: No space left on device ..."
  void expect_named(const std::string& output, const std::string& below) const {
    const auto reason = output.find(GetParam().reason);
    ASSERT_NE(reason, std::string::npos) << output;
    const auto line = output.rfind('\n', reason) + 1;
    EXPECT_NE(output.substr(line, reason - line).find(below), std::string::npos) << output;
  }
};

const char* const kShort = R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [2, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
clamps: [{surface: x0}]
gravity: [0, 0, -1]
checkpoint: {frames: 1}
time: {end: 0.08}
integrator: {type: arkode_dirk, step: 0.02, rtol: 1e-10, position_scale: 0.1, velocity_scale: 0.1}
events: [{quantity: tip.displacement.z, crosses: -1e-3}]
output:
  interval: 0.04
  momentum: true
  probes: {tip: {at: [1, 0.1, 0.1]}}
)";

class RunOnFaultyDisk : public OnFaultyDisk {
 protected:
  RunOnFaultyDisk() { write("beam.yaml", kShort); }

  // Frames, tables and record equal those of an undisturbed run.
  void expect_equal_results(const std::string& name, const std::string& whole) const {
    EXPECT_EQ(Json::parse(read_text(folder_ / name / "run.json")).at("status"), "completed");
    EXPECT_LT(difference(folder_ / whole, folder_ / name), 1e-6);
    expect_same_times(folder_ / whole, folder_ / name);
    for (const char* table : {"steps.csv", "events.csv"})
      EXPECT_EQ(lines(folder_ / name / table), lines(folder_ / whole / table)) << table;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / name))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
  static std::ptrdiff_t lines(const fs::path& file) {
    const std::string text = read_text(file);
    return std::count(text.begin(), text.end(), '\n');
  }
};

TEST_P(RunOnFaultyDisk, ARunSaysSoAndGoesOn) {
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out whole").exit_code, 0);
  for_each_write(
      "run beam.yaml --quiet", [&] { fs::remove_all(folder_ / "out"); },
      [&](const Result& result) {
        EXPECT_TRUE(result.exit_code == 3 ||
                    (result.exit_code == 0 && result.output.find("warning") != std::string::npos))
            << result.exit_code << result.output;
        expect_named(result.output, "out/beam");
        const auto again = orthodyn("run beam.yaml --quiet --resume");
        ASSERT_EQ(again.exit_code, 0) << result.output << again.output;
        expect_equal_results("out/beam", "whole");
      });
}

// Earlier results are not lost while a run is extended.
TEST_P(RunOnFaultyDisk, ARunThatIsExtendedKeepsWhatItHas) {
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out whole --set time.end=0.16").exit_code, 0);
  ASSERT_EQ(orthodyn("run beam.yaml --quiet --out short").exit_code, 0);
  std::map<std::string, std::string> frames;
  for (const auto& entry : fs::directory_iterator(folder_ / "short/frames"))
    frames[entry.path().filename()] = read_text(entry.path());
  ASSERT_EQ(frames.size(), 3u);
  for_each_write(
      "run beam.yaml --quiet --resume --set time.end=0.16",
      [&] {
        fs::remove_all(folder_ / "out");
        fs::create_directory(folder_ / "out");
        fs::copy(folder_ / "short", folder_ / "out/beam", fs::copy_options::recursive);
      },
      [&](const Result& result) {
        EXPECT_TRUE(result.exit_code == 3 ||
                    (result.exit_code == 0 && result.output.find("warning") != std::string::npos))
            << result.exit_code << result.output;
        expect_named(result.output, "out/beam");
        for (const auto& [name, content] : frames) EXPECT_EQ(read_text(folder_ / "out/beam/frames" / name), content);
        const auto again = orthodyn("run beam.yaml --quiet --resume --set time.end=0.16");
        ASSERT_EQ(again.exit_code, 0) << result.output << again.output;
        expect_equal_results("out/beam", "whole");
      });
}

class StudyOnFaultyDisk : public OnFaultyDisk {
 protected:
  // The table without values that depend on machine and time.
  static Json figures(const fs::path& table) {
    Json t = Json::parse(read_text(table));
    for (auto& point : t.at("points"))
      for (const char* measured : {"cost", "wall", "cpu", "statistics", "peak_memory_bytes"}) point.erase(measured);
    return t.at("points");
  }

  // `command` writes `table`; it fails, or reports which points failed.
  void expect_it_goes_on(const std::string& command, const fs::path& table) {
    ASSERT_EQ(orthodyn(command).exit_code, 0);
    const Json whole = figures(folder_ / table);
    for_each_write(
        command, [&] { fs::remove_all(folder_ / "out"); },
        [&](const Result& result) {
          EXPECT_TRUE(result.exit_code == 3 || result.exit_code == 0) << result.exit_code << result.output;
          // Without the log file of a process, which only failures need, everything succeeds.
          if (result.exit_code == 0 && result.output.find(GetParam().reason) == std::string::npos)
            EXPECT_EQ(figures(folder_ / table), whole) << result.output;
          else expect_named(result.output, "out/");
          const auto again = orthodyn(command);
          ASSERT_EQ(again.exit_code, 0) << result.output << again.output;
          EXPECT_EQ(figures(folder_ / table), whole) << result.output << again.output;
        });
  }
};

TEST_P(StudyOnFaultyDisk, ASweepSaysSoAndGoesOn) {
  write("scene.yaml", kOscillator);
  write("s.yaml",
        "scene: scene.yaml\nvary: {materials.soft.young: [1e5, 2e5]}\n"
        "quantities: {far: {quantity: node.displacement.x, take: max}}\n");
  expect_it_goes_on("sweep s.yaml --no-report --jobs 1", "out/sweeps/s/sweep.json");
}

TEST_P(StudyOnFaultyDisk, AComparisonSaysSoAndGoesOn) {
  write("scene.yaml", kOscillator);
  write("c.yaml",
        "scenes: [scene.yaml]\nintegrators: [{type: tr_bdf2}]\ntolerances: [1e-3]\nrepeats: 1\nsamples: 4\n"
        "reference: {kind: computed, integrator: {type: ida_bdf, max_order: 5, rtol: 1e-7}, check: {type: cvode_bdf, "
        "max_order: 5, rtol: 1e-7}}\n");
  expect_it_goes_on("compare c.yaml --no-report", "out/comparisons/c/compare.json");
}

const auto kDisks = testing::Values(FaultyDisk{"Full", Kind::full, "No space left on device"},
                                    FaultyDisk{"Broken", Kind::broken, "Input/output error"});
const auto kNameOf = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Disks, RunOnFaultyDisk, kDisks, kNameOf);
INSTANTIATE_TEST_SUITE_P(Disks, StudyOnFaultyDisk, kDisks, kNameOf);

}  // namespace
}  // namespace orthodyn::full_disk_test
