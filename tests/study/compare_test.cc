// `orthodyn compare` end to end: results, failures, interruption.
#include <csignal>
#include <fstream>
#include <set>
#include <thread>

#include "lib/simulation/output/json.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::compare_test {
namespace {

const char* const kSmall = R"(scenes: [swing.yaml]
integrators: [cvode_bdf, ida_bdf]
tolerances: [1e-2, 1e-3, 1e-4]
repeats: 2
samples: 40
reference:
  integrator: {type: ida_bdf, max_order: 5, rtol: 1e-8}
  check: {type: cvode_bdf, max_order: 5, rtol: 1e-7}
)";

class Compare : public InFolder {
 protected:
  Compare() {
    write("swing.yaml", kSwing);
    write("c.yaml", kSmall);
  }
  Json table() const { return Json::parse(read_text(folder_ / "out/comparisons/c/compare.json")); }
  CommandResult compare(const std::string& more = "") const { return orthodyn("compare c.yaml --no-report" + more); }

  // Files of finished points, which must not change when a comparison is continued.
  std::set<std::pair<std::string, std::string>> finished() const {
    std::set<std::pair<std::string, std::string>> out;
    if (!fs::exists(folder_ / "out/comparisons/c")) return out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out/comparisons/c"))
      if (entry.path().filename() == "result.json") out.emplace(entry.path().string(), read_text(entry.path()));
    return out;
  }
};

TEST_F(Compare, MeasuresEveryPointAgainstACheckedReference) {
  const auto done = compare();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const Json t = table();
  EXPECT_TRUE(t.at("complete"));
  ASSERT_EQ(t.at("points").size(), 6u);
  for (const auto& point : t.at("points")) {
    EXPECT_EQ(point.at("status"), "completed") << point.dump();
    EXPECT_EQ(point.at("repeats"), 2);
    EXPECT_GT(point.at("wall").at("median"), 0);
    const double rtol = point.at("control").at("value"), error = point.at("errors").at("displacement").at("l2");
    EXPECT_LT(error, 30 * rtol);
    EXPECT_GT(error, 0.01 * rtol);
    EXPECT_EQ(point.at("near_reference").size(), 0u);
    EXPECT_TRUE(point.at("errors").at("probes").contains("tip"));
    EXPECT_GT(point.at("statistics").at("steps"), 0);
    EXPECT_GT(point.at("peak_memory_bytes"), 1e6);
    EXPECT_EQ(point.at("drift_over_time").at("t").size(), 40u);
    EXPECT_TRUE(point.at("drift").at("angular_momentum").is_null());  // it is clamped
  }
  const double bound = t.at("problems")[0].at("reference").at("errors").at("displacement").at("l2");
  EXPECT_GT(bound, 0);
  EXPECT_LT(bound, 1e-5);
  EXPECT_FALSE(t.at("answers").empty());
  EXPECT_EQ(t.at("orders").size(), 2u);
}

// A probe's displacement as a quantity has the same error as the probe.
TEST_F(Compare, MeasuresTheErrorsOfQuantities) {
  write("c.yaml", kSmall + std::string("quantities: [von_mises.largest, tip.displacement]\n"));
  const auto done = compare();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const Json t = table();
  EXPECT_GT(t.at("problems")[0].at("quantity_scales").at("von_mises.largest"), 0);
  const auto stress = [&](std::size_t point) -> double {
    return t.at("points")[point].at("errors").at("quantities").at("von_mises.largest").at("l2");
  };
  for (const std::size_t first : {0u, 3u}) {  // of each method, whose points are from loose to tight
    EXPECT_LT(stress(first + 1), stress(first));
    EXPECT_LT(stress(first + 2), stress(first + 1));
    EXPECT_GT(stress(first + 2), 0);
  }
  for (const auto& point : t.at("points")) {
    const Json& errors = point.at("errors");
    for (const char* norm : {"final", "l2", "max"})
      EXPECT_NEAR(errors.at("quantities").at("tip.displacement").at(norm).get<double>(),
                  errors.at("probes").at("tip").at(norm).get<double>(), 1e-12);
  }
  EXPECT_NE(read_text(folder_ / "out/comparisons/c/compare.csv").find(",error.von_mises.largest.l2,"),
            std::string::npos);
}

TEST_F(Compare, RefusesQuantitiesThatASceneDoesNotHaveBeforeItBegins) {
  for (const auto& [quantity, words] : {std::pair{"tsai_wu.largest", "strength"},
                                        {"tpi.displacement", "did you mean"},
                                        {"energy.balance", "energy drift"}}) {
    write("c.yaml", std::string("quantities: [") + quantity + "]\n" + kSmall);
    const auto refused = compare();
    EXPECT_EQ(refused.exit_code, 2) << refused.output;
    EXPECT_NE(refused.output.find("c.yaml:1"), std::string::npos) << refused.output;
    EXPECT_NE(refused.output.find(words), std::string::npos) << refused.output;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
}

// Frames are a subset of the samples, so that reference and points have the same times.
TEST_F(Compare, KeepsFramesWhereTheyAreAskedFor) {
  write("c.yaml", kSmall + std::string("frames: {count: 5, fields: [stress]}\n"));
  const auto done = compare();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const Json t = table();
  const fs::path all = folder_ / "out/comparisons/c";
  const std::string reference = read_text(all / t.at("problems")[0].at("reference").at("folder") / "frames.pvd");
  EXPECT_EQ(std::count(reference.begin(), reference.end(), '\n'), 3 + 6 + 2);
  for (const auto& point : t.at("points")) {
    const fs::path folder = (all / point.at("scene")).parent_path();
    EXPECT_EQ(read_text(folder / "frames.pvd"), reference);
    for (const char* field : {"\"displacement\"", "\"stress\""})
      EXPECT_NE(read_text(folder / "frames/frame_00005.vtu").find(field), std::string::npos) << field;
    EXPECT_FALSE(fs::exists(folder / "frames/frame_00006.vtu"));
    EXPECT_TRUE(fs::exists(folder / "setup.vtu"));
  }
  std::size_t kept = 0;
  for (const auto& entry : fs::directory_iterator(all / "references")) kept += fs::exists(entry.path() / "frames.pvd");
  EXPECT_EQ(kept, 1u) << "the check of the reference is shown nowhere";
}

TEST_F(Compare, KeepsNoFramesUnasked) {
  ASSERT_EQ(compare().exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
    EXPECT_NE(entry.path().extension(), ".vtu") << entry.path();
}

TEST_F(Compare, RefusesFramesThatCannotBe) {
  for (const auto& [frames, words] : {std::pair{"{count: 41}", "41 frames requested, but only 40 samples"},
                                      {"{fields: [displacement, strss]}", "did you mean 'stress'"}}) {
    write("c.yaml", std::string("frames: ") + frames + "\n" + kSmall);
    const auto refused = compare();
    EXPECT_EQ(refused.exit_code, 2) << refused.output;
    EXPECT_NE(refused.output.find("c.yaml:1"), std::string::npos) << refused.output;
    EXPECT_NE(refused.output.find(words), std::string::npos) << refused.output;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
}

TEST_F(Compare, TheCsvHoldsTheNumbersOfTheJson) {
  ASSERT_EQ(compare().exit_code, 0);
  std::istringstream csv(read_text(folder_ / "out/comparisons/c/compare.csv"));
  std::string header, row;
  std::getline(csv, header);
  const auto cells = [](const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
    return out;
  };
  const auto titles = cells(header);
  const auto column = [&](const std::string& title) {
    return static_cast<std::size_t>(std::find(titles.begin(), titles.end(), title) - titles.begin());
  };
  const Json t = table();
  for (const auto& point : t.at("points")) {
    ASSERT_TRUE(std::getline(csv, row));
    const auto values = cells(row);
    ASSERT_EQ(values.size(), titles.size());
    EXPECT_EQ(std::stod(values[column("wall.median [s]")]), point.at("wall").at("median"));
    EXPECT_EQ(std::stod(values[column("error.displacement.l2")]), point.at("errors").at("displacement").at("l2"));
    EXPECT_EQ(std::stol(values[column("steps")]), point.at("statistics").at("steps"));
    EXPECT_EQ(values[column("method")], point.at("method").get<std::string>());
  }
  EXPECT_FALSE(std::getline(csv, row));
}

TEST_F(Compare, GoesOnWhereItStopped) {
  ASSERT_EQ(compare().exit_code, 0);
  const auto before = finished();
  write("c.yaml", std::string(kSmall).replace(std::string(kSmall).find("1e-4"), 4, "1e-4, 1e-5"));
  const auto again = compare();
  EXPECT_EQ(again.exit_code, 0);
  for (const auto& file : before) EXPECT_TRUE(finished().contains(file)) << file.first;
}

// A comparison in its own process, until it is stopped or done.
class InBackground {
 public:
  explicit InBackground(const fs::path& folder) {
    child_ = fork();
    if (child_ != 0) return;
    std::freopen("/dev/null", "w", stdout);
    std::freopen("/dev/null", "w", stderr);
    if (chdir(folder.c_str()) == 0) execl(program().c_str(), "orthodyn", "compare", "c.yaml", "--no-report", nullptr);
    _exit(127);
  }
  void signal(int number) const { kill(child_, number); }
  int wait() const {
    int status = 0;
    waitpid(child_, &status, 0);
    return status;
  }

 private:
  pid_t child_;
};

TEST_F(Compare, AKillAtAnyMomentCostsAtMostThePointInProgress) {
  // Each kill waits for one more result, so that kills hit different stages.
  for (std::size_t results = 0; results < 4; ++results) {
    const InBackground running(folder_);
    while (finished().size() < results) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(7 * results));
    const auto before = finished();
    running.signal(SIGKILL);
    running.wait();
    const auto after = finished();
    EXPECT_GE(after.size(), results);
    for (const auto& file : before) EXPECT_TRUE(after.contains(file)) << file.first;
    for (const auto& [path, text] : after) EXPECT_TRUE(Json::accept(text)) << path;  // whole or absent
  }
  const auto before = finished();
  const auto done = compare();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  for (const auto& file : before) EXPECT_TRUE(finished().contains(file)) << file.first;
  EXPECT_EQ(table().at("points").size(), 6u);
}

TEST_F(Compare, AnInterruptKeepsTheTable) {
  write("c.yaml", std::string(kSmall) + "vary: {gravity: [[0, 0, -1], [0, 0, 1], [0, 1, 0]]}\n");
  const InBackground running(folder_);
  while (finished().size() < 4) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  running.signal(SIGINT);
  const int status = running.wait();
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const Json t = table();
  EXPECT_FALSE(t.at("complete"));
  EXPECT_GE(t.at("points").size(), 1u);
  EXPECT_EQ(t.at("planned_points"), 18);
}

TEST_F(Compare, OnlyOneAtATimeWorksInAFolder) {
  const InBackground running(folder_);
  while (finished().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto second = compare();
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.output.find("at work there"), std::string::npos) << second.output;
  EXPECT_EQ(running.wait(), 0);
}

TEST_F(Compare, APointThatTakesTooLongStaysInTheTable) {
  write("c.yaml",
        "scenes: [swing.yaml]\nintegrators: [cvode_bdf]\ntolerances: [1e-2, 1e-9]\nlimits: {seconds: 1e-3}\n"
        "repeats: 1\nreference: {kind: none}\n");
  compare();  // the other point may or may not be done in time
  const Json t = table();
  const Json& tight = t.at("points")[1];
  EXPECT_EQ(tight.at("status"), "failed");
  EXPECT_EQ(tight.at("reason"), "time limit");
  EXPECT_LT(tight.at("time_reached"), 0.5);
  EXPECT_NE(read_text(folder_ / "out/comparisons/c/compare.csv").find("time limit"), std::string::npos);
}

TEST_F(Compare, ARunThatFailsAndAModelThatIsRefusedStayInTheTableWithTheirReasons) {
  write("c.yaml",
        "scenes: [{file: swing.yaml, set: {mass: consistent}}]\ntolerances: [1e-3]\nintegrators:\n"
        "- {type: cvode_bdf, label: short, max_steps: 3}\n- {type: cvode_bdf, label: full, linear_solver: "
        "klu_full}\nrepeats: 1\nreference: {kind: none}\n");
  ASSERT_EQ(compare().exit_code, 3);
  const Json t = table();
  EXPECT_EQ(t.at("points")[0].at("reason"), "too many steps");
  EXPECT_EQ(t.at("points")[1].at("reason"), "refused");
  EXPECT_NE(t.at("points")[1].at("message").get<std::string>().find("mass: lumped"), std::string::npos);
}

TEST_F(Compare, AProcessThatDiesIsNoResultThatLasts) {
  ASSERT_EQ(compare().exit_code, 0);
  const Json before = table();
  const fs::path point =
      folder_ / "out/comparisons/c" / fs::path(before.at("points")[0].at("scene").get<std::string>());
  std::ofstream(point.parent_path() / "result.json") << R"({"status": "failed", "reason": "crashed", "message": "x"})";
  const auto again = compare();
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_EQ(table().at("points")[0].at("status"), "completed");
  for (std::size_t k = 1; k < 6; ++k) EXPECT_EQ(table().at("points")[k], before.at("points")[k]);  // not done again
}

TEST_F(Compare, ACutReferenceIsComputedAgain) {
  ASSERT_EQ(compare().exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out/comparisons/c/references"))
    if (entry.path().filename() == "trajectory.bin") fs::resize_file(entry.path(), 100);
  const auto again = compare();
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_EQ(again.output.find("swing, reference: done (done before)"), std::string::npos) << again.output;
  EXPECT_EQ(table().at("problems")[0].at("reference").at("kind"), "computed");
}

TEST_F(Compare, MemoryIsLimited) {
  write("c.yaml",
        "scenes: [swing.yaml]\nintegrators: [cvode_bdf]\ntolerances: [1e-9]\nlimits: {memory: 1e6}\n"
        "repeats: 1\nreference: {kind: none}\n");
  ASSERT_EQ(compare().exit_code, 3);
  EXPECT_EQ(table().at("points")[0].at("reason"), "out of memory");
}

TEST_F(Compare, NothingIsConcludedFromAReferenceThatCouldNotBeChecked) {
  write("c.yaml", std::string(kSmall).replace(std::string(kSmall).find("check: {"), 8, "check: {max_steps: 3, "));
  const auto done = compare();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  EXPECT_NE(done.output.find("could not be checked"), std::string::npos) << done.output;
  const Json t = table();
  EXPECT_FALSE(t.at("problems")[0].at("reference").at("checked"));
  EXPECT_TRUE(t.at("answers").empty());
  EXPECT_TRUE(t.at("orders").empty());
  EXPECT_FALSE(t.at("points")[0].at("near_reference").empty());
}

TEST_F(Compare, AReferenceThatFailsLeavesTheTimes) {
  write("c.yaml",
        std::string(kSmall).replace(std::string(kSmall).find("integrator: {"), 13, "integrator: {max_steps: 3, "));
  ASSERT_EQ(compare().exit_code, 0);
  const Json t = table();
  EXPECT_EQ(t.at("problems")[0].at("reference").at("kind"), "none");
  EXPECT_TRUE(t.at("points")[0].at("errors").is_null());
  EXPECT_GT(t.at("points")[0].at("wall").at("median"), 0);
}

TEST_F(Compare, TextThatIsNotUtf8IsNoObstacle) {
  write("swing.yaml", std::string("# Balken aus Gr\xfcnholz\n") + kSwing);
  EXPECT_EQ(compare().exit_code, 0);
}

TEST_F(Compare, ALinearSceneIsMeasuredAgainstItsExactSolution) {
  write("c.yaml",
        "scenes: [{file: swing.yaml, set: {elasticity.kinematics: linear}}]\nintegrators: [cvode_bdf]\n"
        "tolerances: [1e-3, 1e-5, 1e-7]\nrepeats: 1\n");
  ASSERT_EQ(compare().exit_code, 0);
  const Json t = table();
  EXPECT_EQ(t.at("problems")[0].at("reference").at("kind"), "exact");
  EXPECT_LT(t.at("points")[2].at("errors").at("displacement").at("l2"), 1e-5);
  EXPECT_LT(t.at("points")[2].at("errors").at("velocity").at("max"), 1e-4);
}

TEST_F(Compare, ErrorsFallWithTheToleranceAsTheOrderSays) {
  write("c.yaml", R"(scenes: [{file: swing.yaml, set: {elasticity.kinematics: linear}}]
integrators: [cvode_bdf, ida_bdf]
tolerances: [1e-3, 1e-4, 1e-5, 1e-6, 1e-7]
vary: {integrator.max_order: [2, 5]}
repeats: 1
)");
  ASSERT_EQ(compare().exit_code, 0);
  const Json t = table();
  ASSERT_EQ(t.at("orders").size(), 4u);
  for (const auto& order : t.at("orders")) {
    const double k = order.at("method").get<std::string>().ends_with("2") ? 2 : 5;
    EXPECT_GT(order.at("slope"), k / (k + 1) - 0.15) << order.dump();
    EXPECT_LT(order.at("slope"), 1.2) << order.dump();
  }
}

TEST_F(Compare, PointsAreMeasuredAgainWhenAFileBesideTheMeshHasChanged) {
  const auto elements = [&](const std::string& first) { write("two.ele", "2 4 1\n" + first + "\n2 1 3 2 5 1\n"); };
  write("two.node", "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n");
  elements("1 1 2 3 4 1");
  write("two.yaml",
        "mesh: {type: file, file: two.node}\nmaterials: {m: {type: isotropic, density: 1, young: 1e3, nu: "
        "0.3}}\ninitial: {spin: [1, 0, 0]}\ntime: {end: 0.1}\n");
  write("c.yaml",
        "scenes: [two.yaml]\nintegrators: [cvode_bdf]\ntolerances: [1e-3]\nrepeats: 1\nreference: {kind: none}\n");
  ASSERT_EQ(compare().exit_code, 0);
  EXPECT_NE(compare().output.find("done before"), std::string::npos);
  elements("1 1 2 3 4 2");
  const auto again = compare();
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(again.output.find("done before"), std::string::npos) << again.output;
}

TEST_F(Compare, AMeshThatCannotBeReadFailsThePointsOfItsSceneOnly) {
  write("bad.msh", "no mesh");
  write("bad.yaml",
        std::string(kSwing).replace(std::string(kSwing).find("{type: box"), 60, "{type: gmsh, file: bad.msh}"));
  write("c.yaml",
        "scenes: [bad.yaml, swing.yaml]\nintegrators: [cvode_bdf]\ntolerances: [1e-3]\nrepeats: 1\n"
        "reference: {kind: none}\n");
  const auto done = compare();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  EXPECT_EQ(table().at("points")[0].at("reason"), "refused");
  EXPECT_EQ(table().at("points")[1].at("status"), "completed");
}

TEST_F(Compare, SaysSoWhereNothingCouldBeMeasuredAndTriesAgainWhenAsked) {
  write("c.yaml",
        "scenes: [swing.yaml]\nintegrators: [cvode_bdf]\ntolerances: [1e-3]\nreference: {kind: none}\n"
        "limits: {seconds: 1e-9}\n");
  const auto failed = compare();
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_NE(failed.output.find("1 of 1 points failed; first: swing, cvode_bdf, rtol 0.001: time limit: "),
            std::string::npos)
      << failed.output;
  const auto kept = compare();
  EXPECT_NE(kept.output.find("(done before)"), std::string::npos) << kept.output;
  EXPECT_NE(kept.output.find("kept 1 failure of an earlier run"), std::string::npos) << kept.output;
  const auto again = compare(" --retry");
  EXPECT_EQ(again.output.find("(done before)"), std::string::npos) << again.output;
}

TEST_F(Compare, NeverWritesIntoAFolderOfSomethingElse) {
  fs::create_directories(folder_ / "mine");
  write("mine/thesis.tex", "precious");
  const auto done = compare(" --out mine");
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_NE(done.output.find("mine: holds files"), std::string::npos) << done.output;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "mine"), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace orthodyn::compare_test
