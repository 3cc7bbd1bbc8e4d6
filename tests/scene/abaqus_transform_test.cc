// *TRANSFORM of an Abaqus input file: which conditions are left out of the scene.
#include <gtest/gtest.h>

#include "tests/scene/abaqus_brick.h"

namespace orthodyn::abaqus_transform_test {
namespace {

// Lines 22 to 25: directions that are turned by 45 degrees about z at the nodes 5 to 8.
const std::string kTurned = "*NSET, NSET=Head\n5, 6, 7, 8\n*TRANSFORM, NSET=Head\n1, 1, 0, -1, 1, 0\n";
const std::string kWhy = "*TRANSFORM (line 24) rotates the directions at the nodes, which is not supported";

TEST(AbaqusTransform, LeavesConditionsAtOtherNodesAlone) {
  const std::string text =
      brick(kTurned + "*BOUNDARY\nFoot, 1\nFoot, 2, 2, 0.5\n*CLOAD\n1, 1, 3\n*DSLOAD\nTop, P, 7\n").text;
  EXPECT_CONTAINS(text, "clamps:\n  - {nodes: Foot, components: [x]}\n");
  EXPECT_CONTAINS(text, "{nodes: Foot, components: [y], translation: [0, 0.5, 0]");
  EXPECT_CONTAINS(text, "{type: point_load, nodes: cload_1, force: [3, 0, 0]}\n");
  EXPECT_CONTAINS(text, "{type: pressure, surface: Top, pressure: 7}\n");
  EXPECT_CONTAINS(text, "# Left out of the file:\n#   *TRANSFORM (line 24)\n");
}

TEST(AbaqusTransform, LeavesOutConditionsAtItsNodes) {
  expect_left_out(kTurned + "*BOUNDARY\nHead, 1\n", "*BOUNDARY (line 27): " + kWhy);
  expect_left_out(kTurned + "*BOUNDARY\nHead, XSYMM\n", "*BOUNDARY (line 27): " + kWhy);
  expect_left_out(kTurned + "*BOUNDARY\n5, 1, 3, 0.5\n", "*BOUNDARY (line 27): " + kWhy);
  expect_left_out(kTurned + "*CLOAD\n7, 1, 3\n", "*CLOAD (line 27): " + kWhy);
  expect_left_out(
      kTurned + "*NSET, NSET=Side\n1, 2, 5\n*CLOAD\nSide, 1, 3\n",
      "*CLOAD (line 29): *TRANSFORM (line 24) rotates the directions at 1 of the 3 nodes, which is not supported");
  EXPECT_EQ(brick(kTurned + "*BOUNDARY\nHead, 1\n").text.find("\nclamps:"), std::string::npos);
}

TEST(AbaqusTransform, OfASetThatTheFileDoesNotHaveMayTurnAll) {
  expect_left_out("*TRANSFORM, NSET=None\n1, 1, 0, -1, 1, 0\n*CLOAD\n7, 1, 1\n",
                  "*CLOAD (line 25): *TRANSFORM (line 22) rotates the directions at the nodes, which is not supported");
}

TEST(AbaqusTransform, LeavesOutTheAmplitudeOfWhatItLeavesOut) {
  const std::string deck = kTurned + "*AMPLITUDE, NAME=A\n0, 0, 1, 1\n*BOUNDARY, AMPLITUDE=A\nHead, 1, 1, 2\n";
  expect_left_out(deck, "*BOUNDARY (line 29): " + kWhy);
  expect_left_out(deck, "*AMPLITUDE A (line 26): not used by a converted condition");
  EXPECT_EQ(brick(deck).text.find("\ntime:"), std::string::npos);
}

// Three fixed components are fixed in any directions.
TEST(AbaqusTransform, LeavesFullyHeldNodesHeld) {
  for (const char* held : {"Head, ENCASTRE\n", "Head, PINNED\n", "Head, 1, 3\n", "Head, 1, 6, 0.\n",
                           "Head, 1\nHead, 2, 2\nHead, 3, 3\n", "Head, XSYMM\nHead, 2, 3\n"}) {
    const AbaqusScene made = brick(kTurned + "*BOUNDARY\n" + held);
    EXPECT_CONTAINS(made.text, "clamps:\n  - {nodes: Head}\n");
    EXPECT_EQ(made.text.find("*BOUNDARY"), std::string::npos) << made.text;
  }
}

TEST(AbaqusTransform, LeavesOutAllOfASetThatIsHeldAndThenMovedInATurnedDirection) {
  const std::string deck = kTurned + "*BOUNDARY\nHead, ENCASTRE\nHead, 2, 2, 0.1\n";
  expect_left_out(deck, "*BOUNDARY (lines 27, 28): " + kWhy);
}

TEST(AbaqusTransform, ThatTurnsNothingLeavesNothingOut) {
  const auto text = [](const std::string& transform) {
    return brick("*NSET, NSET=Head\n5, 6, 7, 8\n*TRANSFORM, NSET=Head" + transform + "*CLOAD\nHead, 1, 3\n").text;
  };
  for (const char* same : {"\n1, 0, 0, 0, 1, 0\n", ", TYPE=R\n2D0, 0, 0, 5, 3, 0\n", "\n1., , , , 1.\n"})
    EXPECT_CONTAINS(text(same), "force: [12, 0, 0]");
  for (const char* other : {"\n1, 0, 0, 0, -1, 0\n", "\n1, 0, 0, 0, 0, 1\n", "\n1, 0, 0, 2, 0, 0\n", "\n",
                            ", TYPE=C\n1, 0, 0, 0, 1, 0\n", ", TYPE=S\n1, 0, 0, 0, 1, 0\n", "\n1, 0, x, 0, 1, 0\n"})
    EXPECT_CONTAINS(text(other), ": " + kWhy + "\n");
}

// The part's y is the negative x of space: there the part's transform is none.
TEST(AbaqusTransform, OfAPartTurnsWithItsInstance) {
  const TemporaryFolder folder;
  const auto text = [&](const char* angle) {
    folder.write("a.inp", std::string("*PART, NAME=P\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
                                      "*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4\n*SOLID SECTION, ELSET=E\n"
                                      "*NSET, NSET=Tip\n4\n*TRANSFORM, NSET=Tip\n0, -1, 0, 1, 0, 0\n*END PART\n"
                                      "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n0, 0, 0\n0, 0, 0, 0, 0, 1, ") +
                              angle + "\n*END INSTANCE\n*END ASSEMBLY\n*CLOAD\nI.Tip, 1, 3\n");
    return scene_of_abaqus(folder.path("a.inp"), "a.inp").text;
  };
  EXPECT_CONTAINS(text("90"), "force: [3, 0, 0]");
  EXPECT_CONTAINS(text("0"), "*CLOAD (line 22): *TRANSFORM (line 12)");
}

}  // namespace
}  // namespace orthodyn::abaqus_transform_test
