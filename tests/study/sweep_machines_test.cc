// `orthodyn sweep` in several processes and on several machines: kills, tasks, job arrays.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "lib/scene/expectation.h"
#include "lib/study/jobs/job_result.h"
#include "tests/study/sweep_command.h"

namespace orthodyn::sweep_machines_test {
namespace {

TEST_F(SweepCommand, LosesAtMostThePointsInProgressWhenItIsKilled) {
  write("s.yaml", kMany);
  ASSERT_EQ(sweep("--jobs 2 --quiet").exit_code, 0);
  const std::string undisturbed = metrics();
  fs::remove_all(folder_ / "out");
  std::map<std::string, std::string> finished;
  int kills = 0;  // of sweeps that had finished something, but not all
  for (const char* seconds : {"0", "0.013", "0.029", "0.007", "0.02"}) {
    shell("cd " + folder_.string() + " && { " + program() +
          " sweep s.yaml --jobs 2 --quiet --no-report & pid=$!; while kill -0 $pid && [ $(find out -name result.json | "
          "wc -l) -le " +
          std::to_string(finished.size()) + " ]; do sleep 0.005; done; sleep " + seconds +
          "; kill -9 $pid; wait $pid; sleep 0.05; } 2>/dev/null");
    ASSERT_TRUE(fs::exists(folder_ / "out/sweeps/s/points"));
    const auto now = results();
    kills += now.size() > finished.size() && now.size() < 12;
    for (const auto& [file, text] : finished) EXPECT_EQ(now.at(file), text);
    for (const auto& [file, text] : now) EXPECT_FALSE(Json::parse(text, nullptr, false).is_discarded()) << file;
    std::size_t begun = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out/sweeps/s/points")) begun += entry.is_directory();
    EXPECT_LE(begun - now.size(), 2u);
    finished = now;
  }
  EXPECT_GE(kills, 2);
  const auto last = sweep("--jobs 2");
  ASSERT_EQ(last.exit_code, 0) << last.output;
  EXPECT_EQ(metrics(), undisturbed);
  for (const auto& [file, text] : finished) EXPECT_EQ(read_text(file), text);
}

TEST_F(SweepCommand, IsDoneByIndependentTasksAndJoined) {
  write("s.yaml", kMany);
  sweep("--quiet");
  const std::string whole = metrics();
  fs::remove_all(folder_ / "out");
  EXPECT_EQ(sweep("--task 1/3 --jobs 1").exit_code, 0);
  EXPECT_EQ(sweep("--task 3/3 --jobs 1").exit_code, 0);
  const auto part = sweep("--collect");
  EXPECT_EQ(part.exit_code, 3);
  EXPECT_NE(part.output.find("4 of 12 points are missing"), std::string::npos) << part.output;
  EXPECT_EQ(table().at("missing"), 4);
  // Two processes at a time in one folder, as on a cluster.
  shell("cd " + folder_.string() + " && { " + program() + " sweep s.yaml --task 2/3 --jobs 1 --quiet & " + program() +
        " sweep s.yaml --task 1/3 --jobs 1 --quiet; wait; }");
  EXPECT_EQ(sweep("--collect").exit_code, 0);
  EXPECT_EQ(metrics(), whole);
}

TEST_F(SweepCommand, CollectListsAsManyPointsAsItCounts) {
  write("s.yaml", kMany);
  EXPECT_EQ(sweep("--task 1/4 --jobs 1").exit_code, 0);
  const auto lines_in = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  const auto missing = [&] {
    const std::string said = sweep("--collect").output;
    const auto head = said.find("points are missing:\n"), tail = said.find("run the command without");
    return head == std::string::npos ? 0 : lines_in(said.substr(head, tail - head)) - 1;
  };
  EXPECT_EQ(sweep("--task 2/4 --jobs 1").exit_code, 0);
  EXPECT_EQ(missing(), 6);
  EXPECT_EQ(table().at("missing"), 6);
  // A process that died leaves a reason: the point is in the table and not missing.
  const std::string some = results().begin()->first;
  study::write_result(fs::path(some).parent_path(), study::to_json(study::Failure{"crashed", "ended by signal 9"}));
  EXPECT_EQ(missing(), 6);
  EXPECT_EQ(table().at("missing"), 6);
  EXPECT_EQ(sweep("--quiet").exit_code, 0);
  EXPECT_EQ(missing(), 0);
  EXPECT_EQ(read_text(some).find("crashed"), std::string::npos);
  EXPECT_EQ(table().at("missing"), 0);
}

TEST_F(SweepCommand, LeavesNoFolderForATaskThatCannotBe) {
  write("s.yaml", kMany);
  for (const char* task : {"0/3", "4/3", "1", "x"})
    EXPECT_EQ(sweep(std::string("--task ") + task).exit_code, 2) << task;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(SweepCommand, PrintsAnArrayWithATaskForEveryShareOfThePoints) {
  write("s.yaml", kMany);
  const std::string script = sweep("--slurm --tasks 6").output;
  EXPECT_NE(script.find("#SBATCH --array=1-6\n"), std::string::npos) << script;
  EXPECT_NE(script.find("--task \"$SLURM_ARRAY_TASK_ID/6\" --jobs 1"), std::string::npos) << script;
  EXPECT_FALSE(fs::exists(folder_ / "out/sweeps/s"));
  // A shell script replaces the scheduler.
  write("array.sh", script);
  shell("cd / && for i in 1 2 3 4 5 6; do SLURM_ARRAY_TASK_ID=$i sh " + (folder_ / "array.sh").string() + "; done");
  EXPECT_EQ(sweep("--collect").exit_code, 0);
}

TEST_F(SweepCommand, PrintsAnArrayForNamesWithBlanksAndPatterns) {
  write("my 5% \"s\".yaml", std::string(kMany) + "limits: {memory: 1e9}\n");
  const std::string script = orthodyn("sweep 'my 5% \"s\".yaml' --slurm").output;
  EXPECT_NE(script.find(R"(--job-name="my 5% \"s\""
)"),
            std::string::npos)
      << script;
  EXPECT_NE(script.find(R"(out/sweeps/my 5%% \"s\".log"
)"),
            std::string::npos)
      << script;
  EXPECT_NE(script.find("#SBATCH --mem=1512M\n"), std::string::npos) << script;
}

TEST_F(SweepCommand, PrintsNoArrayForANameWithALineBreak) {
  write("a\ntouch made #.yaml", kMany);
  for (const char* out : {"", " --out out/fine"}) {
    const auto result = orthodyn(std::string("sweep 'a\ntouch made #.yaml' --slurm") + out);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_EQ(result.output.find("#SBATCH"), std::string::npos) << result.output;
  }
}

// nu = 0.6 is not a valid material, and the surface 'nowhere' does not exist.
TEST_F(SweepCommand, TellsOfPointsThatCannotBeBeforeAnArrayIsPrinted) {
  const auto array_of = [&](const std::string& vary) {
    write("s.yaml", "scene: scene.yaml\nimpossible: keep\nquantities: {far: {quantity: node.displacement.x}}\nvary: " +
                        vary + "\n");
    return sweep("--slurm");
  };
  for (const char* vary : {"{materials.soft.nu: [0.6, 0.7]}", "{loads.0.surface: [nowhere, neither]}"}) {
    const auto none = array_of(vary);
    EXPECT_EQ(none.exit_code, 2) << none.output;
    EXPECT_NE(none.output.find("none of the points can be computed"), std::string::npos) << none.output;
    EXPECT_EQ(none.output.find("#SBATCH"), std::string::npos) << none.output;
  }
  const auto some = array_of("{materials.soft.nu: [0.3, 0.6]}");
  EXPECT_EQ(some.exit_code, 0) << some.output;
  EXPECT_NE(some.output.find("warning: nu 0.6 cannot be computed"), std::string::npos) << some.output;
}

TEST_F(SweepCommand, RefusesAFolderOfSomethingElse) {
  write("s.yaml", kMany);
  fs::create_directories(folder_ / "other");
  write("other/thesis.txt", "mine");
  const auto refused = sweep("--out other");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("holds files that are not of a sweep"), std::string::npos) << refused.output;
}

}  // namespace
}  // namespace orthodyn::sweep_machines_test
