// `orthodyn stability` end to end: grades, refusals, errors, and kills.
#include <map>
#include <random>

#include "lib/study/jobs/json_values.h"
#include "lib/study/stability/stability_matrix.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::study::stability::stability_test {
namespace {

// Free fall: g t^2 / 2 = 4.905 m in one second.
const std::string kFall = R"(# A block falls.
mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
gravity: [0, 0, -9.81]
time: {end: 1}
integrator: {rtol: 1e-6}
output: {probes: {corner: {at: [0, 0, 0]}}}
)";

std::string expecting(double depth, const std::string& more = "") {
  return kFall + "expect: [{quantity: corner.displacement.z, value: -" + std::to_string(depth) +
         ", absolute: 0.01, source: g t^2 / 2, reason: r" + more + "}]\n";
}

const std::string kMatrix = "cases: [fall.yaml]\nintegrators: [cvode_bdf, tr_bdf2]\n";

class StabilityCommand : public InFolder {
 protected:
  StabilityCommand() { write("fall.yaml", expecting(4.905)); }
  CommandResult stability(const std::string& more = "") const {
    return orthodyn("stability m.yaml --no-report" + more);
  }
  Json table() const { return read_json(folder_ / "out/stability/m/stability.json"); }
  std::string grade(std::size_t trial) const { return table().at("trials").at(trial).at("grade"); }
};

TEST_F(StabilityCommand, GradesByTheDistanceInTolerances) {
  const std::map<double, std::string> grades{{4.905, "pass"}, {4.955, "degraded"}, {5.105, "fail"}};
  for (const auto& [depth, word] : grades) {
    write("fall.yaml", expecting(depth));
    write("m.yaml", kMatrix);
    ASSERT_EQ(stability().exit_code, 0);
    EXPECT_EQ(grade(0), word);
    EXPECT_EQ(grade(1), word);
  }
  write("fall.yaml", expecting(5.105, ", degraded: 100"));
  ASSERT_EQ(stability().exit_code, 0);
  EXPECT_EQ(grade(0), "degraded");
}

TEST_F(StabilityCommand, SuspectsAnExpectationThatAllIntegratorsMissAlike) {
  write("fall.yaml", expecting(5.105));
  write("m.yaml", kMatrix);
  const auto done = stability();
  EXPECT_NE(done.output.find("agree on end of corner.displacement.z"), std::string::npos) << done.output;
  ASSERT_EQ(table().at("suspected").size(), 1u);
  write("fall.yaml", expecting(4.905));
  stability();
  EXPECT_TRUE(table().at("suspected").empty());
}

Json trial(const std::string& integrator, const std::string& grade, const Json& computed) {
  return {{"case", "fall"},
          {"variant", "default"},
          {"status", "completed"},
          {"integrator", integrator},
          {"grade", grade},
          {"worst", {{"title", "depth"}, {"computed", computed}, {"expected", 2}, {"limit", 0.1}}}};
}

TEST(SuspectedExpectations, AreThoseThatAllMissWithinTheLimitOfEachOther) {
  const Json cases = Json::array({{{"label", "fall"}, {"model", ""}}});
  const auto count = [&](const Json& first, const Json& second) {
    return suspected_expectations(cases, Json::array({first, second})).size();
  };
  EXPECT_EQ(count(trial("a", "fail", 3.0), trial("b", "fail", 3.05)), 1u);
  EXPECT_EQ(count(trial("a", "fail", 3.0), trial("b", "degraded", 3.05)), 1u);
  EXPECT_EQ(count(trial("a", "fail", 3.0), trial("b", "fail", 3.2)), 0u);
  EXPECT_EQ(count(trial("a", "fail", 3.0), trial("b", "pass", 2.05)), 0u);
  EXPECT_EQ(count(trial("a", "fail", 3.0), trial("b", "fail", nullptr)), 0u);
  const Json explained = Json::array({{{"label", "fall"}, {"model", "why"}}});
  const Json alike = Json::array({trial("a", "fail", 3.0), trial("b", "fail", 3.0)});
  EXPECT_TRUE(suspected_expectations(explained, alike).empty());
}

TEST_F(StabilityCommand, SaysWhatWasExpectedAndLeavesTheLastState) {
  write("fall.yaml", expecting(5.105));
  write("m.yaml", kMatrix);
  const auto done = stability();
  EXPECT_NE(done.output.find("end of corner.displacement.z is -4.9"), std::string::npos) << done.output;
  const Json trial = table().at("trials").at(0);
  EXPECT_NEAR(trial.at("worst").at("computed").get<double>(), -4.905, 1e-3);
  EXPECT_EQ(trial.at("worst").at("expected").get<double>(), -5.105);
  EXPECT_EQ(trial.at("time_reached").get<double>(), 1);
  EXPECT_GT(trial.at("statistics").at("steps").get<int>(), 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/stability/m" / trial.at("folder").get<std::string>() / "end.vtu"));
  const std::string csv = read_text(folder_ / "out/stability/m/stability.csv");
  EXPECT_NE(csv.find("fall,default,cvode_bdf,fail,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",metric,unit,computed,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",end of corner.displacement.z,m,-4.9"), std::string::npos) << csv;
}

TEST_F(StabilityCommand, TakesVariantsAndRefusalsApart) {
  write("m.yaml",
        "cases: [fall.yaml]\nintegrators: [energy_momentum, cvode_bdf]\n"
        "variants: {exact: {}, warped: {elasticity.corotation: warped}}\n");
  const auto done = stability();
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const Json t = table();
  ASSERT_EQ(t.at("trials").size(), 4u);
  EXPECT_EQ(grade(0), "pass");
  EXPECT_EQ(grade(2), "refused");
  EXPECT_NE(t.at("trials").at(2).at("reason").get<std::string>().find("elasticity.corotation: exact"),
            std::string::npos);
  EXPECT_EQ(grade(3), "pass");
}

TEST_F(StabilityCommand, TheSameTrialByTwoNamesIsDoneOnce) {
  write("m.yaml",
        "cases: [fall.yaml]\nintegrators: [cvode_bdf, {type: cvode_bdf, label: again}]\n"
        "variants: {exact: {}, same: {}}\n");
  const auto done = stability(" --jobs 4");
  ASSERT_EQ(done.exit_code, 0) << done.output;
  ASSERT_EQ(table().at("trials").size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(grade(k), "pass");
}

// The load's formula becomes NaN during the run: a failure, not a refusal, and it is not repeated.
TEST_F(StabilityCommand, WhatTheInputDoesWrongInMidRunIsAFailure) {
  write("fall.yaml",
        expecting(4.905) +
            "loads: [{surface: z1, force: [0, 0, 1], factor: {type: expression, formula: sqrt(0.5-t)}}]\n");
  write("m.yaml", "cases: [fall.yaml]\nintegrators: [cvode_bdf]\n");
  ASSERT_EQ(stability().exit_code, 0);
  EXPECT_EQ(grade(0), "fail");
  EXPECT_NE(stability().output.find("(done before)"), std::string::npos);
}

TEST_F(StabilityCommand, ARunThatDoesNotEndFails) {
  write("m.yaml",
        "cases: [fall.yaml]\nintegrators: [{type: cvode_bdf, max_steps: 3}, {type: backward_euler, label: slow, h_max: "
        "1e-8, max_steps: 100000000}]\nlimits: {seconds: 0.3}\n");
  ASSERT_EQ(stability().exit_code, 0);
  EXPECT_EQ(grade(0), "fail");
  EXPECT_NE(table().at("trials").at(0).at("reason").get<std::string>().find("max_steps"), std::string::npos);
  EXPECT_EQ(grade(1), "fail");
  EXPECT_EQ(table().at("trials").at(1).at("reason"), "time limit");
  const auto again = stability();
  EXPECT_NE(again.output.find("kept 1 failure of an earlier run"), std::string::npos) << again.output;
  const auto retried = stability(" --retry");
  EXPECT_EQ(retried.output.find("(done before)"), std::string::npos) << retried.output;
  EXPECT_EQ(retried.output.find("--retry"), std::string::npos) << retried.output;
}

TEST_F(StabilityCommand, RefusesWhatIsWrongBeforeAnythingRuns) {
  const std::map<std::string, std::string> wrong{
      {"cases: []\n", "m.yaml:1:8: cases: is empty"},
      {"cases: [none.yaml]\n", "m.yaml:1:9: cases.0: none.yaml: no such file"},
      {"cases: [fall.yaml, fall.yaml]\n", "m.yaml:1:20"},
      {"cases: [fall.yaml]\nintegrators: [cvode_bfd]\n", "did you mean 'cvode_bdf'"},
      {"cases: [fall.yaml]\nintegrators: [{type: cvode_bdf, rtoll: 1}]\n",
       "m.yaml:2:40: integrators.0.rtoll: unknown key"},
      {"cases: [{file: fall.yaml, set: {gravty: 1}}]\n", "m.yaml:1:41: cases.0.set.gravty: unknown key"},
      {"cases: [fall.yaml]\nvariants: {a: {elasticity.corotatoin: warped}}\n",
       "m.yaml:2:39: variants.a.elasticity.corotatoin: unknown key"}};
  for (const auto& [text, message] : wrong) {
    write("m.yaml", text);
    const auto done = stability();
    EXPECT_EQ(done.exit_code, 2) << text << done.output;
    EXPECT_NE(done.output.find(message), std::string::npos) << text << done.output;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
  write("fall.yaml", kFall);
  write("m.yaml", kMatrix);
  const auto done = stability();
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_NE(done.output.find("no 'expect' list"), std::string::npos) << done.output;
}

// Repeated kills only lose the runs in progress.
TEST_F(StabilityCommand, AKillCostsTheTrialsInProgress) {
  write("m.yaml", "cases: [fall.yaml]\nintegrators: [all]\n");
  const auto files = [&](const std::string& name) {
    std::map<std::string, std::string> out;
    if (!fs::exists(folder_ / "out")) return out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
      if (entry.path().filename() == name) out[entry.path().string()] = read_text(entry.path());
    return out;
  };
  std::mt19937 random(1);
  std::map<std::string, std::string> before;
  for (std::size_t kill = 1; kill <= 5; ++kill) {
    const std::size_t enough = before.size() + 1 + random() % 3;
    shell("cd " + folder_.string() + "; " + program() +
          " stability m.yaml --no-report --jobs 2 > said & pid=$!; until [ $(find out -name result.json 2> /dev/null | "
          "wc -l) -ge " +
          std::to_string(enough) + " ]; do sleep 0.005; done; kill -9 $pid; wait $pid");
    const auto after = files("result.json");
    EXPECT_GT(after.size(), before.size());
    EXPECT_LE(files("scene.yaml").size(), after.size() + 2);                  // begun, and lost
    for (const auto& [file, text] : before) EXPECT_EQ(after.at(file), text);  // not done again
    for (const auto& [file, text] : after) EXPECT_TRUE(Json::accept(text)) << text;
    before = after;
  }
  ASSERT_EQ(stability(" --jobs 2").exit_code, 0);
  EXPECT_TRUE(table().at("complete").get<bool>());
  EXPECT_EQ(table().at("trials").size(), table().at("integrators").size());
  for (const auto& [file, text] : before) EXPECT_EQ(read_text(file), text);
}

Check off_by(double tolerances, double degraded = 10) {
  Expectation e;
  e.quantity = "q";
  e.absolute = 1;
  e.degraded = degraded;
  return {e, tolerances};
}

TEST(CaseGrade, TheWorstMetricDecides) {
  const auto grade_of = [](const std::vector<Check>& checks) { return grade({"", {}, checks}).grade; };
  EXPECT_EQ(grade_of({off_by(0.5), off_by(1)}), Grade::pass);
  EXPECT_EQ(grade_of({off_by(0.5), off_by(-1.5)}), Grade::degraded);
  EXPECT_EQ(grade_of({off_by(15), off_by(0.5)}), Grade::fail);
  EXPECT_EQ(grade_of({off_by(15, 20), off_by(3, 2)}), Grade::fail);
  EXPECT_EQ(grade_of({off_by(0), off_by(std::nan(""))}), Grade::fail);
  EXPECT_EQ(grade({"", {}, {off_by(15, 20), off_by(3, 2)}}).worst->computed, 3);
}

}  // namespace
}  // namespace orthodyn::study::stability::stability_test
