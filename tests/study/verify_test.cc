// Verification: passes, failures, refusals.
#include "lib/study/quantities/verify.h"

#include <sstream>

#include "tests/simulation/run_program.h"

namespace orthodyn::study::verify_test {
namespace {

// Free fall: g t^2 / 2 = 4.905 m in one second.
const std::string kFall = R"(mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e5, nu: 0.3}}
gravity: [0, 0, -9.81]
time: {end: 1}
integrator: {rtol: 1e-8}
output: {probes: {corner: {at: [0, 0, 0]}}}
)";

std::string expecting(const std::string& entry) {
  return kFall + "expect: [{" + entry + ", source: g t^2 / 2, reason: a polynomial of degree 2}]\n";
}

class Verify : public InFolder {};

TEST_F(Verify, AKnownMetricPasses) {
  write("fall.yaml", expecting("quantity: corner.displacement.z, value: -4.905, relative: 1e-4"));
  const auto done = orthodyn("verify fall.yaml");
  EXPECT_EQ(done.exit_code, 0) << done.output;
  EXPECT_NE(done.output.find("pass"), std::string::npos);
}

TEST_F(Verify, OneWrongDigitMisses) {
  write("fall.yaml", expecting("quantity: corner.displacement.z, value: -4.907, relative: 1e-4"));
  const auto done = orthodyn("verify fall.yaml");
  EXPECT_EQ(done.exit_code, 1) << done.output;
  EXPECT_NE(done.output.find("MISS"), std::string::npos);
  EXPECT_NE(done.output.find("expected from g t^2 / 2"), std::string::npos) << done.output;
}

TEST_F(Verify, TakesMetricsAtATimeAndOverTime) {
  write("cases/fall.yaml", "");
  fs::create_directories(folder_ / "cases");
  write("cases/fall.yaml", kFall + R"(expect:
- {quantity: corner.displacement.z, at: 0.5, value: -1.22625, relative: 1e-4, source: s, reason: r}
- {quantity: corner.velocity.magnitude, take: max, value: 9.81, relative: 1e-4, source: s, reason: r}
- {quantity: corner.velocity.z, take: time_of_min, value: 1, relative: 1e-6, source: s, reason: r}
- {quantity: corner.displacement.z, take: mean, value: -1.635, relative: 1e-3, source: s, reason: r}
- {quantity: momentum.linear, take: drift, of: 9810, value: 1, relative: 1e-4, source: s, reason: r}
- {quantity: energy.balance, take: drift, value: 0, absolute: 1e-4, source: s, reason: r}
)");
  const auto done = orthodyn("verify cases --junit out.xml");
  EXPECT_EQ(done.exit_code, 0) << done.output;
  const std::string xml = read_text(folder_ / "out.xml");
  EXPECT_NE(xml.find("tests=\"6\" failures=\"0\" errors=\"0\""), std::string::npos) << xml;
}

// A rod of one linear element along x. Its first axial mode u x/L has omega^2 = 3 E/(rho L^2), with E/rho = 1000
// m^2/s^2 and L = 1 m. In the dynamic run its end stays at rest.
TEST_F(Verify, TakesModesBesideMetricsOfAMotion) {
  write("rod.yaml", R"(mesh: {type: box, size: [1, 0.01, 0.01], cells: [1, 1, 1], order: 1}
materials: {m: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
mass: consistent
clamps: [{surface: x0}, {surface: x1, components: [y, z]}]
time: {end: 0.1}
output: {probes: {end: {at: [1, 0, 0]}}}
expect:
- {quantity: end.displacement.x, value: 0, absolute: 1 nm, source: s, reason: r}
- {mode: 1, value: 8.717252 Hz, relative: 1e-6, source: sqrt(3 E/rho)/(2 pi L), reason: one element}
- {mode: 20, value: 1, relative: 1e-6, source: s, reason: there are four unknowns}
)");
  const auto done = orthodyn("verify rod.yaml");
  EXPECT_EQ(done.exit_code, 1) << done.output;
  std::vector<std::string> passed, missed;
  std::istringstream lines(done.output);
  for (std::string line; std::getline(lines, line);)
    if (line.ends_with(" pass")) passed.push_back(line);
    else if (line.ends_with(" MISS")) missed.push_back(line);
  EXPECT_EQ(passed.size(), 2u) << done.output;
  ASSERT_EQ(missed.size(), 1u) << done.output;
  EXPECT_NE(missed[0].find("frequency of mode 20"), std::string::npos) << missed[0];
}

TEST_F(Verify, JUnitTellsWhatWasMissedAndEscapesIt) {
  write("fall.yaml", kFall +
                         "expect: [{quantity: corner.displacement.z, value: 1, relative: 1e-4, source: 'a < b & "
                         "\"c\"', reason: r}]\n");
  EXPECT_EQ(orthodyn("verify fall.yaml --junit out.xml").exit_code, 1);
  const std::string xml = read_text(folder_ / "out.xml");
  EXPECT_NE(xml.find("<failure message=\"computed -4.905"), std::string::npos) << xml;
  EXPECT_NE(xml.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos) << xml;
}

TEST_F(Verify, ARunThatFailsIsAMissWithItsReason) {
  write("fall.yaml", expecting("quantity: corner.displacement.z, value: -4.905, relative: 1e-4"));
  const auto done = orthodyn("verify fall.yaml --set integrator.max_steps=3 --junit out.xml");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_NE(done.output.find("max_steps"), std::string::npos) << done.output;
  EXPECT_NE(read_text(folder_ / "out.xml").find("errors=\"1\""), std::string::npos);
}

TEST_F(Verify, GoesOnAfterAFileThatCannotBeRead) {
  const std::string good = expecting("quantity: corner.displacement.z, value: -4.905, relative: 1e-4");
  write("a.yaml", "mesh: {type: bax}\n");
  write("b.yaml", good);
  const auto done = orthodyn("verify a.yaml nowhere.yaml b.yaml --junit out.xml");
  EXPECT_EQ(done.exit_code, 2) << done.output;
  for (const char* words :
       {"did you mean 'box'", "nowhere.yaml: no such file", "1 of 1 cases pass", "2 could not be read"})
    EXPECT_NE(done.output.find(words), std::string::npos) << words << "\n" << done.output;
  const std::string xml = read_text(folder_ / "out.xml");
  EXPECT_NE(xml.find("tests=\"3\" failures=\"0\" errors=\"2\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("did you mean 'box'"), std::string::npos) << xml;
}

struct Refusal {
  const char *entry, *says;
};
class VerifyRefuses : public Verify, public testing::WithParamInterface<Refusal> {};

TEST_P(VerifyRefuses, WhatCannotBeMeant) {
  write("fall.yaml", expecting(GetParam().entry));
  const auto done = orthodyn("verify fall.yaml");
  EXPECT_EQ(done.exit_code, 2) << done.output;
  EXPECT_NE(done.output.find(GetParam().says), std::string::npos) << done.output;
  EXPECT_NE(done.output.find("fall.yaml:7"), std::string::npos) << done.output;
}

INSTANTIATE_TEST_SUITE_P(
    Expectations, VerifyRefuses,
    testing::Values(Refusal{"quantity: corner.displacement.q, value: 1, relative: 1", "unknown quantity"},
                    Refusal{"quantity: corner.displacment.z, value: 1, relative: 1", "corner.displacement.z"},
                    Refusal{"quantity: corner.displacement, value: 1, relative: 1", "has several components"},
                    Refusal{"quantity: corner.displacement.z, value: 1", "exactly one of relative, absolute"},
                    Refusal{"quantity: corner.displacement.z, value: 0, relative: 1e-3", "value 0"},
                    Refusal{"quantity: corner.displacement.z, value: 1, relative: 1, at: 3", "time span"},
                    Refusal{"quantity: corner.displacement.z, value: 1, relative: 1, at: 1, take: max",
                            "replaces 'take'"},
                    Refusal{"quantity: corner.displacement.z, value: 1, relative: 1, of: 2", "take: drift"},
                    Refusal{"value: 1, relative: 1", "exactly one of: quantity, mode, buckling"},
                    Refusal{"mode: 1, value: 1, relative: 1, take: max", "are for quantities"},
                    Refusal{"mode: 1, value: 1 kg, relative: 1", "Hz"},
                    Refusal{"buckling: 1, value: 1, relative: 1", "analysis: buckling"}));

TEST_F(Verify, RefusesAFolderWithoutCasesAndASceneWithoutExpectations) {
  write("plain.yaml", kFall);
  EXPECT_NE(orthodyn("verify plain.yaml").output.find("nothing to verify"), std::string::npos);
  EXPECT_EQ(orthodyn("verify plain.yaml").exit_code, 2);
  fs::create_directories(folder_ / "empty");
  EXPECT_EQ(orthodyn("verify empty").exit_code, 2);
  EXPECT_EQ(orthodyn("verify nowhere").exit_code, 2);
}

}  // namespace
}  // namespace orthodyn::study::verify_test
