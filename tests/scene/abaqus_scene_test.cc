// The scene that `orthodyn init --from` makes of an Abaqus input file.
#include "lib/scene/abaqus_scene.h"

#include <gtest/gtest.h>

#include "tests/mesh/refusal.h"

namespace orthodyn::abaqus_scene_test {
namespace {

std::string scene(const std::string& material) {
  const TemporaryFolder folder;
  folder.write("a.inp", "*NODE, NSET=All\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
                        "*ELEMENT, TYPE=C3D4, ELSET=Upper-part\n1, 1, 2, 3, 4\n*SURFACE, NAME=Base\n1, S1\n"
                        "*ORIENTATION, NAME=O\n0, 1, 0, -1, 0, 0\n*MATERIAL, NAME=M\n" + material +
                        "*SOLID SECTION, ELSET=Upper-part, MATERIAL=m, ORIENTATION=O\n*BOUNDARY\n1, 1, 3\n");
  return scene_of_abaqus(folder.path("a.inp"), "a.inp");
}

TEST(AbaqusScene, HasMeshSectionAndOrientationAndListsTheRest) {
  const std::string text = scene("*ELASTIC\n2e11, 0.3\n*DENSITY\n7800\n");
  EXPECT_CONTAINS(text, "mesh: {type: file, file: \"a.inp\"}");
  EXPECT_CONTAINS(text, "  M: {type: isotropic, density: 7800, young: 200000000000, nu: 0.3}\n");
  EXPECT_CONTAINS(text, "  \"Upper-part\": {material: M, axes: {type: file, file: \"a.inp\"}}\n");
  EXPECT_CONTAINS(text, "# surfaces: Base\n# node sets: All\n# left out: *BOUNDARY\n");
}

// Abaqus lists nu12, nu13, nu23 and G12, G13, G23, the last on a line of its own, and C by columns in the order 11 22 33
// 12 13 23.
TEST(AbaqusScene, ConstantsStandInTheirOrder) {
  EXPECT_CONTAINS(scene("*DENSITY\n400\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n11, 22, 33, .12, .13, .23, 12, 13\n23\n"),
                  "young: [11, 22, 33], nu12: 0.12, nu23: 0.23, nu13: 0.13, g12: 12, g23: 23, g13: 13}");
  EXPECT_CONTAINS(scene("*DENSITY\n400\n*ELASTIC, TYPE=ORTHO\n11, 12, 22, 13, 23, 33, 44, 55\n66, 20.\n"),
                  "voigt_order: abaqus, density: 400, c11: 11, c12: 12, c22: 22, c13: 13, c23: 23, c33: 33, c44: 44, c55: 55, c66: 66}");
  EXPECT_CONTAINS(scene("*DENSITY\n400\n*ELASTIC, TYPE=ANISOTROPIC\n11, 12, 22, 13, 23, 33, 14, 24\n34, 44, 15, 25, 35, 45, "
                        "55, 16\n26, 36, 46, 56, 66\n"),
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

}  // namespace
}  // namespace orthodyn::abaqus_scene_test
