// `--ranks` of sweep, converge and compare: several processes per point.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/simulation/several_ranks.h"

namespace orthodyn::study_ranks_test {
namespace {

class StudiesOnRanks : public SeveralRanks {
 protected:
  CommandResult study(const std::string& arguments) const {
    return shell("cd " + folder_.string() + " && " + for_any_user() + program() + " " + arguments + " --no-report");
  }
  // Bytes, summed over all points.
  double memory(const std::string& folder) const {
    double sum = 0;
    for (const auto& file : fs::recursive_directory_iterator(folder_ / folder))
      if (file.path().filename() == "result.json")
        sum += nlohmann::json::parse(read_text(file.path())).at("cost").at("peak_memory").get<double>();
    return sum;
  }
  nlohmann::json table(const std::string& file) const { return nlohmann::json::parse(read_text(folder_ / file)); }
};

const std::string kSweep = R"(
scene: beam.yaml
vary: {gravity: {values: [[0, 0, -1], [0, 0, -2]]}}
quantities:
  tip: {quantity: tip.displacement.z, take: min}
  steps: {cost: steps}
  memory: {cost: peak_memory}
)";

TEST_F(StudiesOnRanks, SweepsHaveTheFiguresOfOne) {
  write("beam.yaml", kBeam + std::string("time: {end: 0.2}\nintegrator: {type: generalized_alpha, step: 0.01}\n"));
  write("s.yaml", kSweep);
  ASSERT_EQ(study("sweep s.yaml --quiet --out one").exit_code, 0);
  const auto result = study("sweep s.yaml --ranks 2 --out two");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto one = table("one/sweep.json").at("points"), two = table("two/sweep.json").at("points");
  ASSERT_EQ(two.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const double expected = one[k].at("metrics").at("tip");
    EXPECT_NEAR(two[k].at("metrics").at("tip"), expected, 1e-5 * std::abs(expected));
    EXPECT_EQ(two[k].at("metrics").at("steps"), one[k].at("metrics").at("steps"));
    // Computed by two processes.
    EXPECT_GT(two[k].at("metrics").at("memory"), 1.5 * one[k].at("metrics").at("memory").get<double>());
  }
  const std::string script = study("sweep s.yaml --ranks 2 --slurm").output;
  EXPECT_NE(script.find("#SBATCH --ntasks=2\n"), std::string::npos) << script;
  EXPECT_NE(script.find("--mem-per-cpu="), std::string::npos) << script;
  EXPECT_NE(script.find(" --ranks 2"), std::string::npos) << script;
}

TEST_F(StudiesOnRanks, WhatOneProcessComputesIsRefused) {
  write("beam.yaml", kBeam + std::string("time: {end: 0.2}\n"));
  write("s.yaml", kSweep + "  first: {mode: 1}\n");
  const auto sweep = study("sweep s.yaml --ranks 2");
  EXPECT_EQ(sweep.exit_code, 2);
  EXPECT_NE(sweep.output.find("s.yaml:8"), std::string::npos) << sweep.output;
  EXPECT_EQ(study("converge beam.yaml --modes 2 --ranks 2").exit_code, 2);
}

// The message of a failed rank is reported, although the other ranks end, too.
TEST_F(StudiesOnRanks, AFailureIsThePointsResult) {
  write("beam.yaml", kBeam + std::string("time: {end: 0.2}\nintegrator: {type: generalized_alpha, step: 0.01}\n"));
  std::string sweep = kSweep;
  sweep.replace(
      sweep.find("gravity: {values: [[0, 0, -1], [0, 0, -2]]}"), 43,
      "kind: {stepping: {integrator: {type: tr_bdf2, rtol: 1e-3}}, modal: {integrator: {type: modal, modes: 3}}}");
  write("s.yaml", sweep);
  const auto result = study("sweep s.yaml --ranks 2");
  EXPECT_NE(result.output.find("does not run on several ranks"), std::string::npos) << result.output;
  write("c.yaml", "scenes: [beam.yaml]\nintegrators: [tr_bdf2, {type: modal, modes: 3}]\ntolerances: [1e-2]\n");
  const auto comparison = study("compare c.yaml --ranks 2");
  EXPECT_EQ(comparison.exit_code, 2) << comparison.output;
}

TEST_F(StudiesOnRanks, RefinementsHaveTheFiguresOfOne) {
  write("bent.yaml", R"(
analysis: static
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 1, 1]}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, 20]}]
output: {probes: {tip: {at: [1, 0.1, 0.1]}}}
)");
  ASSERT_EQ(study("converge bent.yaml --levels 2 --quiet --out one").exit_code, 0);
  const auto result = study("converge bent.yaml --levels 2 --ranks 2 --out two");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(table("two/convergence.json").at("ranks"), 2);
  EXPECT_GT(memory("two"), 1.5 * memory("one"));  // two processes have computed each
  const auto one = table("one/convergence.json").at("rows"), two = table("two/convergence.json").at("rows");
  ASSERT_EQ(two.size(), one.size());
  for (std::size_t k = 0; k < two.size(); ++k) {
    EXPECT_EQ(two[k].at("unknowns"), one[k].at("unknowns"));
    for (const auto& [name, value] : one[k].at("metrics").items())
      EXPECT_NEAR(two[k].at("metrics").at(name).at("value").get<double>(), value.at("value"), 1e-6) << name;
  }
}

TEST_F(StudiesOnRanks, ComparisonsHaveTheErrorsOfOne) {
  write("beam.yaml", kBeam + std::string("time: {end: 0.2}\n"));
  write("c.yaml", R"(
scenes: [beam.yaml]
integrators: [generalized_alpha]
steps: [0.02, 0.01]
samples: 10
repeats: 1
reference:
  integrator: {type: arkode_dirk, rtol: 1e-7}
  check: {type: tr_bdf2, rtol: 1e-6}
)");
  const auto alone = study("compare c.yaml --quiet --out one");
  ASSERT_EQ(alone.exit_code, 0) << alone.output;
  const auto result = study("compare c.yaml --ranks 2 --out two");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(table("two/compare.json").at("settings").at("ranks"), 2);
  const auto one = table("one/compare.json").at("points"), two = table("two/compare.json").at("points");
  ASSERT_EQ(two.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto error_of = [](const auto& point) { return point.at("errors").at("displacement").at("l2"); };
    const double expected = error_of(one[k]);
    EXPECT_NEAR(error_of(two[k]), expected, 1e-3 * expected);
    EXPECT_GT(two[k].at("peak_memory_bytes"), 1.5 * one[k].at("peak_memory_bytes").get<double>());
  }
}

}  // namespace
}  // namespace orthodyn::study_ranks_test
