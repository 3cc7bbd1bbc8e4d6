// Materials, regions and axes that a scene without `materials` takes from an Abaqus file.
#include <gtest/gtest.h>

#include "lib/material_axes/axes_source.h"
#include "lib/mesh/mesh_source.h"
#include "tests/mesh/refusal.h"
#include "tests/scene/scenes.h"

namespace orthodyn::deck_materials_test {
namespace {

const std::string kMesh =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*ELEMENT, TYPE=C3D4, ELSET=Body\n1, 1, 2, 3, 4\n";
const std::string kIsotropic = "*ELASTIC\n2e11, 0.25\n*DENSITY\n7800\n";

// The tet with this material; its keywords begin in line 9.
class DeckScene : public testing::Test {
 protected:
  std::string yaml(const std::string& material, const std::string& mesh_keys = "", const std::string& section = "") {
    folder_.write("a.inp", kMesh + "*MATERIAL, NAME=Wood\n" + material + "*SOLID SECTION, ELSET=Body, MATERIAL=wood" +
                               section + "\n");
    return "mesh: {type: file, file: " + folder_.path("a.inp") + mesh_keys + "}\ntime: {end: 1}\n";
  }
  Scene scene(const std::string& text) { return read_scene(Config::from_text(text, "scene.yaml")); }
  std::string refusal_of_scene(const std::string& text) {
    return refusal_of([&] { scene(text); });
  }
  // Rows and columns 11, 22, 33, 12, 23, 31.
  Eigen::Matrix<double, 6, 6> stiffness(const Scene& s) { return voigt(s.materials.at(0).second->stiffness()); }

  TemporaryFolder folder_;
};

TEST_F(DeckScene, AnIsotropicMaterialHasLamesConstants) {
  const Scene s = scene(yaml(kIsotropic));
  ASSERT_EQ(s.materials.size(), 1u);
  EXPECT_EQ(s.materials[0].first, "Wood");
  EXPECT_EQ(s.materials[0].second->density(), 7800);
  const double lambda = 0.8e11, mu = 0.8e11;  // E nu / ((1 + nu)(1 - 2 nu)), E / (2 (1 + nu))
  const auto C = stiffness(s);
  EXPECT_NEAR(C(0, 0), lambda + 2 * mu, 1e-12 * lambda);
  EXPECT_NEAR(C(0, 1), lambda, 1e-12 * lambda);
  EXPECT_NEAR(C(3, 3), mu, 1e-12 * mu);
  ASSERT_EQ(s.regions.size(), 1u);
  EXPECT_EQ(s.regions[0].first, "Body");
  EXPECT_EQ(s.regions[0].second.material, "Wood");
}

// The compliance has 1/E_i, -nu_ij/E_i and 1/G_ij.
TEST_F(DeckScene, EngineeringConstantsAreE123ThenNu12Nu13Nu23ThenG12G13G23) {
  const Scene s = scene(
      yaml("*DENSITY\n500\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n10e9, 8e9, 5e9, 0.2, 0.3, 0.4, 1e9, 2e9\n3e9\n"));
  const Eigen::Matrix<double, 6, 6> S = stiffness(s).inverse();
  const auto expect = [&](int i, int j, double value) { EXPECT_NEAR(S(i, j), value, 1e-12 / 1e9) << i << j; };
  expect(0, 0, 1 / 10e9);
  expect(1, 1, 1 / 8e9);
  expect(2, 2, 1 / 5e9);
  expect(0, 1, -0.2 / 10e9);
  expect(0, 2, -0.3 / 10e9);
  expect(1, 2, -0.4 / 8e9);
  expect(3, 3, 1 / 1e9);  // 12
  expect(4, 4, 1 / 3e9);  // 23
  expect(5, 5, 1 / 2e9);  // 31
}

TEST_F(DeckScene, OrthotropicStiffnessIsListedByColumnsAndThenThe12The13AndThe23) {
  const Scene s = scene(yaml("*DENSITY\n500\n*ELASTIC, TYPE=ORTHOTROPIC\n11, 1, 22, 2, 3, 33, 4, 5\n6\n"));
  const auto C = stiffness(s);
  EXPECT_DOUBLE_EQ(C(0, 0), 11);
  EXPECT_DOUBLE_EQ(C(0, 1), 1);
  EXPECT_DOUBLE_EQ(C(1, 1), 22);
  EXPECT_DOUBLE_EQ(C(0, 2), 2);
  EXPECT_DOUBLE_EQ(C(1, 2), 3);
  EXPECT_DOUBLE_EQ(C(2, 2), 33);
  EXPECT_DOUBLE_EQ(C(3, 3), 4);  // 1212
  EXPECT_DOUBLE_EQ(C(5, 5), 5);  // 1313
  EXPECT_DOUBLE_EQ(C(4, 4), 6);  // 2323
}

TEST_F(DeckScene, MillimetresTonsAndSecondsAreConverted) {
  const Scene s = scene(yaml("*ELASTIC\n210000, 0\n*DENSITY\n7.8e-9\n", ", units: mm_t_s"));
  EXPECT_NEAR(stiffness(s)(0, 0), 210e9, 1e-3);
  EXPECT_NEAR(s.materials[0].second->density(), 7800, 1e-9);
  EXPECT_EQ(bounding_box(s.loaded->mesh).max, Vec3::Constant(0.001));
  EXPECT_CONTAINS(refusal_of_scene(yaml(kIsotropic, ", units: mm_t_s, scale: 0.001")),
                  "mesh.scale: cannot be combined with `units: mm_t_s`");
}

TEST_F(DeckScene, TheAxesOfASectionAreThoseOfItsOrientation) {
  const std::string orientation = "*ORIENTATION, NAME=O\n0, 1, 0, -1, 0, 0\n";
  const std::string text = yaml(orientation + "*MATERIAL, NAME=Wood\n" + kIsotropic, "", ", ORIENTATION=O");
  const Config resolved = Config::from_text(text, "scene.yaml").resolving();
  const Scene s = read_scene(resolved);
  Warnings notes;
  const Mat3 Q = s.regions.at(0).second.axes->field(s.loaded->mesh, notes)(Vec3::Zero(), 0);
  EXPECT_EQ(Q.col(0), Vec3(0, 1, 0));
  EXPECT_EQ(Q.col(1), Vec3(-1, 0, 0));
  read_scene(Config::from_text(resolved.dump(), "scene.yaml"));
}

// Materials of the scene replace those of the deck, which are then not checked.
TEST_F(DeckScene, WhatTheLawHasNotIsRefusedAtItsLineUnlessMaterialsAreTyped) {
  const std::string text = yaml(kIsotropic + "*PLASTIC\n1e8, 0\n");
  EXPECT_CONTAINS(refusal_of_scene(text), "a.inp:13: material 'Wood' of the mesh: *PLASTIC is not supported");
  scene(text + "materials: {wood: {type: isotropic, density: 1000, young: 1e6, nu: 0.3}}\n");
}

TEST_F(DeckScene, RefusalsNameTheLineOfTheDeck) {
  const auto expect = [&](const std::string& material, const std::string& message) {
    EXPECT_CONTAINS(refusal_of_scene(yaml(material)), message);
  };
  expect("*DENSITY\n1\n*ELASTIC\n1, 0.3, 20\n2, 0.3, 40\n",
         "a.inp:11: material 'Wood' of the mesh: *ELASTIC is not one set of 2 constants");
  expect("*DENSITY\n1\n*ELASTIC, DEPENDENCIES=1\n1, 0.3\n",
         "a.inp:11: material 'Wood' of the mesh: *ELASTIC, DEPENDENCIES is not read");
  expect("*DENSITY\n1\n*ELASTIC, TYPE=LAMINA\n1, 2, 0.3, 1, 1, 1\n", "TYPE=LAMINA is not read");
  expect("*ELASTIC\n1, 0.3\n", "a.inp:8: material 'Wood' of the mesh: it has no *DENSITY");
  expect("*DENSITY\n-1\n*ELASTIC\n1, 0.3\n", "a.inp:9: material 'Wood' of the mesh: *DENSITY is -1");
  expect("*DENSITY\n1\n*ELASTIC\n1, 0.5\n", "a.inp:11: material of the mesh");  // as of a typed one
  expect("*DENSITY\n1\n*ELASTIC\n-1, 0.3\n", "a.inp:11: material of the mesh");
  expect("*DENSITY\n1\n*ELASTIC\n1e200, 0.3\n", "a.inp:11: material of the mesh");
  expect("*DENSITY\n1\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1, 1, 1, 0.2, 0.2, 1.5, 1, 1\n1\n", "indefinite");
  expect("*DENSITY\n1\n*ELASTIC, TYPE=ORTHOTROPIC\n1, 2, 1, 0, 0, 1, 1, 1\n1\n", "indefinite");
  const std::string other = kMesh + "*SOLID SECTION, ELSET=Body, MATERIAL=steel\n";
  folder_.write("b.inp", other);
  EXPECT_CONTAINS(refusal_of_scene("mesh: {type: file, file: " + folder_.path("b.inp") + "}\ntime: {end: 1}\n"),
                  "b.inp:8: material 'STEEL' of the mesh: the file has no such *MATERIAL");
  folder_.write("c.inp", kMesh);
  EXPECT_CONTAINS(refusal_of_scene("mesh: {type: file, file: " + folder_.path("c.inp") + "}\ntime: {end: 1}\n"),
                  "'materials' is missing, and the mesh file has none");
}

TEST_F(DeckScene, WhatHasNoEffectIsNamed) {
  const Scene s = scene(yaml(kIsotropic + "*EXPANSION\n1e-5\n*CONDUCTIVITY\n50\n"));
  ASSERT_EQ(s.loaded->warnings.size(), 1u);
  EXPECT_CONTAINS(s.loaded->warnings[0],
                  "material 'Wood' of the mesh: not used by orthodyn: *EXPANSION, *CONDUCTIVITY");
}

// Keywords after the end of a material do not belong to it.
TEST_F(DeckScene, AMaterialEndsWithOtherKeywords) {
  EXPECT_EQ(scene(yaml(kIsotropic + "*BOUNDARY\n1, 1, 3\n*STEP\n*STATIC\n*PLASTIC\n")).materials.size(), 1u);
}

}  // namespace
}  // namespace orthodyn::deck_materials_test
