// *AMPLITUDE of an Abaqus input file in the scene that `orthodyn init --from` makes of it.
#include <gtest/gtest.h>

#include "tests/scene/abaqus_brick.h"

namespace orthodyn::abaqus_amplitude_test {
namespace {

const std::string kPulse = "*AMPLITUDE, NAME=Pulse\n0., 0., 0.1, 1., 0.2, 0.5\n3D-1, 0.\n";  // lines 22 to 24
const std::string kTable = "factor: {type: table, points: [[0, 0], [0.1, 1], [0.2, 0.5], [0.3, 0]]}}";

TEST(AbaqusAmplitude, BecomesTheFactorOfLoadsAndMotions) {
  const auto text = [](const std::string& lines) { return brick(kPulse + lines).text; };
  EXPECT_CONTAINS(text("*CLOAD, AMPLITUDE=PULSE\n7, 1, 2\n"), "force: [2, 0, 0], " + kTable);
  EXPECT_CONTAINS(text("*DLOAD, AMPLITUDE=Pulse\n1, P2, 7\n"), "pressure: 7, " + kTable);
  EXPECT_CONTAINS(text("*DSLOAD, AMPLITUDE=Pulse\nTop, P, 7\n"), "pressure: 7, " + kTable);
  EXPECT_CONTAINS(text("*DSLOAD, FOLLOWER=NO, AMPLITUDE=Pulse\nTop, TRVEC, 5, 0, 0, 1\n"),
                  "traction: [0, 0, 5], " + kTable);
  EXPECT_CONTAINS(text("*BOUNDARY, AMPLITUDE=Pulse\nFoot, 2, 2, 3\n"), "translation: [0, 3, 0], " + kTable);
  EXPECT_EQ(text("*CLOAD, AMPLITUDE=PULSE\n7, 1, 2\n").find("Left out"), std::string::npos);
}

TEST(AbaqusAmplitude, OfOneComponentIsNotThatOfOthers) {
  const std::string text =
      brick(kPulse +
            "*BOUNDARY\nFoot, 1, 1, 4\nFoot, 3\n*BOUNDARY, AMPLITUDE=Pulse\nFoot, 2, 2, 3\n"
            "*CLOAD\n7, 1, 2\n*NSET, NSET=Tip\n7\n*CLOAD\nTip, 1, 2\n*CLOAD, AMPLITUDE=Pulse\nTip, 1, 5\n")
          .text;
  EXPECT_CONTAINS(text, "clamps:\n  - {nodes: Foot, components: [z]}\n");
  EXPECT_CONTAINS(text, "{nodes: Foot, components: [x], translation: [4, 0, 0], factor: {type: constant}}\n");
  EXPECT_CONTAINS(text, "{nodes: Foot, components: [y], translation: [0, 3, 0], " + kTable);
  EXPECT_CONTAINS(text, "{type: point_load, nodes: Tip, force: [2, 0, 0]}\n");
  EXPECT_CONTAINS(text, "{type: point_load, nodes: Tip, force: [5, 0, 0], " + kTable);
}

TEST(AbaqusAmplitude, OfALongTableStandsOnSeveralLines) {
  std::string points;
  for (int k = 0; k < 7; ++k) points += std::to_string(k) + ", 1\n";
  EXPECT_CONTAINS(brick("*AMPLITUDE, NAME=A\n" + points + "*CLOAD, AMPLITUDE=A\n7, 1, 2\n").text,
                  "[4, 1], [5, 1],\n        [6, 1]]}}\n");
}

// Statics take factors at the end of the scene's time, which without `time` is 0. Both procedures have the period of
// the step as their second number; Abaqus' own default is 1.
TEST(AbaqusAmplitude, IsOverTheTimeOfTheFirstStep) {
  const std::string load = "*CLOAD, AMPLITUDE=Pulse\n7, 1, 2\n";
  EXPECT_CONTAINS(brick(kPulse + "*STEP\n*STATIC\n0.1, 0.25, 1e-5\n" + load).text, "\ntime: {end: 0.25} ");
  for (const std::string procedure : {"*VISCO, CETOL=1e-3", "*COUPLED TEMPERATURE-DISPLACEMENT, DELTMX=1."})
    EXPECT_CONTAINS(brick(kPulse + "*STEP\n" + procedure + "\n0.1, 0.25\n" + load).text, "\ntime: {end: 0.25} ");
  EXPECT_CONTAINS(brick(kPulse + "*STEP\n*STATIC\n" + load).text, "\ntime: {end: 1} ");
  EXPECT_CONTAINS(brick(kPulse + "*STEP\n*STATIC\n0.1, 0.\n" + load).text, "\ntime: {end: 1} ");
  EXPECT_CONTAINS(brick(kPulse + "*STEP\n*STATIC\n0.1, 2\n" + load + "*STEP\n*STATIC\n0.1, 3\n").text, "{end: 2} ");
  const std::string moves = brick(kPulse + "*STEP\n*DYNAMIC, EXPLICIT\n, 0.25\n" + load, {}).text;
  EXPECT_CONTAINS(moves, "# The first step of the file ends at 0.25 s.\n");
  EXPECT_EQ(moves.find("\ntime:"), std::string::npos);
  EXPECT_EQ(brick("*STEP\n*STATIC\n0.1, 0.25\n*CLOAD\n7, 1, 2\n").text.find("\ntime:"), std::string::npos);
}

// Total time starts at the first step, the only one that is converted.
TEST(AbaqusAmplitude, InTotalTimeIsThatOfTheFirstStep) {
  const std::string deck = replaced(kPulse, "NAME=Pulse", "NAME=Pulse, TIME=TOTAL TIME, VALUE=RELATIVE") +
                           "*STEP\n*STATIC\n*CLOAD, AMPLITUDE=Pulse\n7, 1, 2\n*END STEP\n*STEP\n";
  EXPECT_CONTAINS(brick(deck).text, "force: [2, 0, 0], " + kTable);
  expect_left_out(deck + "*CLOAD, AMPLITUDE=Pulse\n8, 1, 2\n",
                  "*CLOAD (line 32): belongs to a later step; only the first step is converted");
}

TEST(AbaqusAmplitude, ThatIsNoTableOfFactorsIsLeftOutByNameWithWhatHasIt) {
  const auto expect = [](const std::string& parameters, const std::string& points, const std::string& why) {
    const std::string deck =
        "*AMPLITUDE, NAME=A" + parameters + "\n" + points + "\n*BOUNDARY, AMPLITUDE=A\nFoot, 1, 1, 2\n";
    expect_left_out(deck, "*BOUNDARY (line 25): " + why);
    expect_left_out(deck, "*AMPLITUDE A (line 22): not used by a converted condition");
  };
  const std::string table = "0, 0, 1, 1";
  expect(", DEFINITION=PERIODIC", "1, 6.28, 0, 0", "DEFINITION=PERIODIC of *AMPLITUDE A (line 22) is not read");
  expect(", DEFINITION=SMOOTH STEP", table, "DEFINITION=SMOOTH STEP of *AMPLITUDE A (line 22) is not read");
  expect(", SMOOTH=0.1", table, "SMOOTH of *AMPLITUDE A (line 22) is not read");
  expect(", VALUE=ABSOLUTE", table, "VALUE=ABSOLUTE of *AMPLITUDE A (line 22) is not read");
  expect(", SCALEX=2", table, "SCALEX of *AMPLITUDE A (line 22) is not read");
  expect(", INPUT=none.txt", table, "INPUT of *AMPLITUDE A (line 22) is not read");
  expect("", "0, 0, 1, one", "*AMPLITUDE A (line 22) has no pairs of a time and a value");
  expect("", "0, 0, 1, 1, 1, 2", "the times of *AMPLITUDE A (line 22) do not ascend");
}

TEST(AbaqusAmplitude, ThatTheFileDoesNotHaveIsNamed) {
  expect_left_out("*CLOAD, AMPLITUDE=B\n7, 1, 2\n", "*CLOAD (line 23): the file has no *AMPLITUDE B");
}

TEST(AbaqusAmplitude, OfGravityIsLeftOut) {
  expect_left_out(kPulse + "*DLOAD, AMPLITUDE=Pulse\nAll, GRAV, 9.81, 0, 0, -1\n",
                  "*DLOAD (line 26): gravity cannot vary in time");
}

// For motions Abaqus/Standard's default is SMOOTH=0.25; a table of a scene is not smoothed.
TEST(AbaqusAmplitude, OfAMotionSaysThatAbaqusRoundsItsCorners) {
  const std::string deck = kPulse + "*BOUNDARY, AMPLITUDE=Pulse\nFoot, 2, 2, 3\n";
  EXPECT_CONTAINS(brick(deck, {}).text, kTable + "   # Abaqus/Standard rounds the corners (SMOOTH=0.25)\n");
  EXPECT_CONTAINS(brick(deck).text, kTable + "\n");
}

}  // namespace
}  // namespace orthodyn::abaqus_amplitude_test
