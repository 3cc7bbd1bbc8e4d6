// run.json contains every term of the model with its values.
#include "lib/simulation/output/json.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::model_keys_test {
namespace {

const char* const kEveryTerm = R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 1, 1], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 100 kPa, nu: 0.3}}
damping: {stiffness: 0.01, mass: 2}
gravity: [0, 0, -1]
loads: [{surface: x1, force: [0, 0, 3]}]
terms:
  - {type: ground_contact, point: [0, 0, -1], stiffness: 1e6}
  - {type: spring, surface: x1, stiffness: 7}
clamps: [{surface: x0, components: [x, y]}]
motions: [{surface: x0, components: [z], translation: [0, 0, 0.01], factor: {type: ramp, end: 0.1}}]
initial: {velocity: [0.1, 0, 0]}
time: {end: 0.02}
output: {frames: 1}
)";

using GivenTerms = InFolder;

TEST_F(GivenTerms, TheRecordHasEveryTermWithItsFigures) {
  write("all.yaml", kEveryTerm);
  const auto result = orthodyn("run all.yaml --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const Json record = Json::parse(read_text(folder_ / "out/all/run.json"));
  const Json& given = record.at("model").at("given");
  EXPECT_EQ(given.at("materials").at("soft").at("young"), "100 kPa");
  EXPECT_EQ(given.at("damping"), (Json{{"stiffness", 0.01}, {"mass", 2}}));
  EXPECT_EQ(given.at("gravity"), (Json{0, 0, -1}));
  EXPECT_EQ(given.at("loads").at(0).at("force"), (Json{0, 0, 3}));
  EXPECT_EQ(given.at("terms").at(0).at("stiffness"), 1e6);
  EXPECT_EQ(given.at("terms").at(1).at("stiffness"), 7);
  EXPECT_EQ(given.at("clamps").at(0).at("components"), (Json{"x", "y"}));
  EXPECT_EQ(given.at("motions").at(0).at("translation"), (Json{0, 0, 0.01}));
  EXPECT_EQ(given.at("motions").at(0).at("factor").at("end"), 0.1);
  EXPECT_EQ(given.at("initial").at("velocity"), (Json{0.1, 0, 0}));
}

// 40 kg: 1000 kg/m^3 in 0.04 m^3.
TEST_F(GivenTerms, TheTermsInWordsHaveTheirFigures) {
  write("all.yaml", kEveryTerm);
  ASSERT_EQ(orthodyn("run all.yaml --quiet").exit_code, 0);
  const std::string text = read_text(folder_ / "out/all/run.json");
  for (const char* words : {"gravity: [0, 0, -1] m/s^2 on 40 kg", "stiffness-proportional damping of 0.01 s",
                            "mass-proportional damping of 2 1/s", "1e+06 Pa/m"})
    EXPECT_NE(text.find(words), std::string::npos) << words;
}

TEST_F(GivenTerms, WhatASceneDoesNotNameIsNotInTheRecord) {
  write("swing.yaml", kSwing);
  ASSERT_EQ(orthodyn("run swing.yaml --quiet").exit_code, 0);
  const Json given = Json::parse(read_text(folder_ / "out/swing/run.json")).at("model").at("given");
  EXPECT_TRUE(given.contains("gravity"));
  for (const char* key : {"loads", "terms", "motions", "initial"})
    EXPECT_TRUE(!given.contains(key) || given[key].empty()) << key;
}

}  // namespace
}  // namespace orthodyn::model_keys_test
