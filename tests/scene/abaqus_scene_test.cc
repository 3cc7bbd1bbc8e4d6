// The scene that `orthodyn init --from` makes of an Abaqus input file.
#include <gtest/gtest.h>

#include "tests/scene/abaqus_brick.h"

namespace orthodyn::abaqus_scene_test {
namespace {

std::string scene(const std::string& material) {
  const TemporaryFolder folder;
  folder.write("a.inp",
               "*NODE, NSET=All\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
               "*ELEMENT, TYPE=C3D4, ELSET=Upper-part\n1, 1, 2, 3, 4\n*SURFACE, NAME=Base\n1, S1\n"
               "*ORIENTATION, NAME=O\n0, 1, 0, -1, 0, 0\n*MATERIAL, NAME=M\n" +
                   material + "*SOLID SECTION, ELSET=Upper-part, MATERIAL=m, ORIENTATION=O\n*BOUNDARY\n1, 1, 3\n");
  return scene_of_abaqus(folder.path("a.inp"), "a.inp").text;
}

TEST(AbaqusScene, TakesMaterialsOfTheFileWhereTheyCanBeUsed) {
  const std::string text = scene("*ELASTIC\n2e11, 0.3\n*DENSITY\n7800\n");
  EXPECT_CONTAINS(text, "mesh: {type: file, file: \"a.inp\"}");
  EXPECT_CONTAINS(text,
                  "\n#   Upper-part: M {type: isotropic, density: 7800, young: 200000000000, nu: 0.3}, axes by its");
  EXPECT_EQ(text.find("\nmaterials:"), std::string::npos) << text;
  EXPECT_CONTAINS(text, "\nclamps:\n  - {nodes: boundary_1}\n");
  EXPECT_CONTAINS(text, "# surfaces: Base\n# node sets: All\n");
}

TEST(AbaqusScene, TypesMaterialsThatTheFileHasMoreOf) {
  const std::string text = scene("*ELASTIC\n2e11, 0.3\n*DENSITY\n7800\n*PLASTIC\n1e8, 0\n");
  EXPECT_CONTAINS(text, "\n  M: {type: isotropic, density: 7800, young: 200000000000, nu: 0.3}   # without *PLASTIC\n");
  EXPECT_CONTAINS(text, "  \"Upper-part\": {material: M, axes: {type: file, file: \"a.inp\"}}\n");
  EXPECT_CONTAINS(text, "#   *PLASTIC of material M (");
}

// Abaqus lists nu12, nu13, nu23 and G12, G13, G23, the last on a line of its own, and C by columns in the order 11 22
// 33 12 13 23.
TEST(AbaqusScene, ConstantsStandInTheirOrder) {
  EXPECT_CONTAINS(scene("*DENSITY\n400\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n11, 22, 33, .12, .13, .23, 12, 13\n23\n"),
                  "young: [11, 22, 33], nu12: 0.12, nu23: 0.23, nu13: 0.13, g12: 12, g23: 23, g13: 13}");
  EXPECT_CONTAINS(scene("*DENSITY\n400\n*ELASTIC, TYPE=ORTHO\n11, 12, 22, 13, 23, 33, 44, 55\n66, 20.\n"),
                  "voigt_order: abaqus, density: 400, c11: 11, c12: 12, c22: 22, c13: 13, c23: 23, c33: 33, c44: 44, "
                  "c55: 55, c66: 66}");
  EXPECT_CONTAINS(scene("*DENSITY\n400\n*ELASTIC, TYPE=ANISOTROPIC\n11, 12, 22, 13, 23, 33, 14, 24\n34, 44, 15, 25, "
                        "35, 45, 55, 16\n26, 36, 46, 56, 66\n"),
                  "c33: 33, c14: 14, c24: 24, c34: 34, c44: 44, c15: 15, c25: 25, c35: 35, c45: 45, c55: 55, c16: 16, "
                  "c26: 26, c36: 36, c46: 46, c56: 56, c66: 66}");
}

TEST(AbaqusScene, MaterialsThatAreNotReadAreNamedWithTheirReason) {
  const auto reason = [](const std::string& material, const std::string& expected) {
    EXPECT_CONTAINS(scene(material), "  # M: " + expected + "; give it here\n");
  };
  reason("*DENSITY\n1\n", "it has no *ELASTIC");
  reason("*ELASTIC\n1, 0.3\n", "it has no *DENSITY");
  reason("*DENSITY\n1\n*ELASTIC\n1, 0.3, 20\n2, 0.3, 40\n", "*ELASTIC is not one set of 2 constants");
  reason("*DENSITY\n1\n*ELASTIC, TYPE=LAMINA\n1, 2, 0.3, 1, 1, 1\n", "*ELASTIC, TYPE=LAMINA is not read");
  reason("*DENSITY\n1\n*ELASTIC, DEPENDENCIES=1\n1, 0.3\n", "*ELASTIC, DEPENDENCIES is not read");
  reason("*DENSITY\nFIELD\n*ELASTIC\n1, 0.3\n", "*DENSITY by a distribution is not read");
}

TEST(AbaqusScene, BoundaryConditionsBecomeClampsAndMotions) {
  EXPECT_CONTAINS(brick("*BOUNDARY\nFoot, ENCASTRE\n").text, "clamps:\n  - {nodes: Foot}\n");
  EXPECT_CONTAINS(brick("*BOUNDARY\nFoot, ZSYMM\nFoot, 1\n").text, "  - {nodes: Foot, components: [x, z]}\n");
  EXPECT_CONTAINS(
      brick("*BOUNDARY\nFoot, 2, 3, 0.5\n").text,
      "motions:\n  - {nodes: Foot, components: [y, z], translation: [0, 0.5, 0.5], factor: {type: constant}}\n");
  const std::string numbers = brick("*BOUNDARY\n5, 1, 3\n6, 1, 3\n7, 1\n").text;
  EXPECT_CONTAINS(numbers, "  - {nodes: boundary_1}\n  - {nodes: boundary_2, components: [x]}\n");
}

// *CLOAD acts on each node of a set. Gravity, traction and pressure are as they stand.
TEST(AbaqusScene, LoadsBecomeTermsLoadsAndGravity) {
  EXPECT_CONTAINS(brick("*CLOAD\nFoot, 3, 2.5\n").text, "  - {type: point_load, nodes: Foot, force: [0, 0, 10]}");
  EXPECT_CONTAINS(brick("*CLOAD\n7, 1, 2.5\n").text, "{type: point_load, nodes: cload_1, force: [2.5, 0, 0]}\n");
  EXPECT_CONTAINS(brick("*DLOAD\nAll, GRAV, 9.81, 0, 0, -2\n").text, "\ngravity: [0, 0, -9.81]\n");
  EXPECT_CONTAINS(brick("*DLOAD\n1, P2, 7\n").text, "  - {type: pressure, surface: dload_1, pressure: 7}\n");
  EXPECT_CONTAINS(brick("*DSLOAD\nTop, P, 7\n").text, "  - {type: pressure, surface: Top, pressure: 7}\n");
  EXPECT_CONTAINS(brick("*DSLOAD, FOLLOWER=NO\nTop, TRVEC, 5, 0, 3, 4\n").text,
                  "{surface: Top, traction: [0, 3, 4]}\n");
  EXPECT_CONTAINS(brick("*STEP\n*STATIC\n*DSLOAD\nTop, P, 7\n*END STEP\n").text, "elasticity: {kinematics: linear}");
  EXPECT_EQ(brick("*STEP, NLGEOM\n*STATIC\n*END STEP\n").text.find("kinematics"), std::string::npos);
}

TEST(AbaqusScene, MillimetresAndMegapascalsAreConverted) {
  const std::string text =
      brick("*BOUNDARY\nFoot, 1, 1, 2\n*DLOAD\n1, P2, 7\n, GRAV, 9810, 0, 0, -1\n*CLOAD\n7, 1, 3\n",
            {.is_static = true, .units = FileUnits::mm_t_s})
          .text;
  EXPECT_CONTAINS(text, "units: mm_t_s}");
  EXPECT_CONTAINS(text, "translation: [0.002, 0, 0]");
  EXPECT_CONTAINS(text, "pressure: 7000000}");
  EXPECT_CONTAINS(text, "gravity: [0, 0, -9.81]");
  EXPECT_CONTAINS(text, "force: [3, 0, 0]");
}

TEST(AbaqusScene, NamesThatTheFileDoesNotHaveAreSaidToBeMade) {
  const std::string text = brick("*CLOAD\n7, 1, 3\n8, 2, 3\n*DLOAD\n1, P2, 7\n").text;
  EXPECT_CONTAINS(text,
                  "\n# surfaces: Top\n# node sets: Foot\n# made from nodes and faces that conditions list by number: "
                  "dload_1, cload_1, cload_2\n");
  EXPECT_EQ(brick("*CLOAD\nFoot, 1, 3\n").text.find("made from nodes"), std::string::npos);
}

// The body is the set All by way of a set that has it twice.
TEST(AbaqusScene, GravityMayActOnSetsWithinSets) {
  EXPECT_CONTAINS(brick("*ELSET, ELSET=Outer\nAll, All\n*ELSET, ELSET=Whole\nOuter, All\n"
                        "*DLOAD\nWhole, GRAV, 9.81, 0, 0, -1\n")
                      .text,
                  "\ngravity: [0, 0, -9.81]\n");
}

TEST(AbaqusScene, WhatIsLeftOutIsNamedWithItsLine) {
  const auto expect = [](const std::string& conditions, const std::string& what) { expect_left_out(conditions, what); };
  expect("*BOUNDARY\nFoot, 4, 6\n", "*BOUNDARY (line 23): prescribes rotations, which nodes of solids do not have");
  expect("*CLOAD\nFoot, 5, 1\n", "*CLOAD (line 23): is a moment, but nodes of solids have no rotations");
  expect("*CLOAD\nHead, 1, 1\n", "*CLOAD (line 23): the mesh has no such nodes");
  expect("*DLOAD\nAll, BX, 1\n", "*DLOAD (line 23): loads of type BX are not supported");
  expect("*DSLOAD\nTop, HP, 1\n", "*DSLOAD (line 23): loads of type HP are not supported");
  expect("*STEP, NLGEOM\n*DSLOAD\nTop, TRVEC, 5, 0, 3, 4\n*END STEP\n",
         "*DSLOAD (line 24): follower tractions are not supported (FOLLOWER=YES is the default)");
  expect("*STEP\n*END STEP\n*STEP\n*CLOAD\n7, 1, 1\n",
         "*CLOAD (line 26): belongs to a later step; only the first step is converted");
  expect("*BOUNDARY\nFoot, 1\n*STEP\n*BOUNDARY, OP=NEW\nFoot, 2\n",
         "*BOUNDARY (line 23): the first step removes it (OP=NEW)");
  expect("*OUTPUT, FIELD\n", "*OUTPUT (line 22)");
}

}  // namespace
}  // namespace orthodyn::abaqus_scene_test
