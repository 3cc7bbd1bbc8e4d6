// *SOLID SECTION, COMPOSITE of Abaqus and CalculiX input files as layups of regions.
#include <gtest/gtest.h>

#include "lib/mesh/io/abaqus.h"
#include "lib/scene/build.h"
#include "tests/mesh/refusal.h"

namespace orthodyn::deck_layups_test {
namespace {

const std::string kNodes =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 0.3\n6, 1, 0, 0.3\n7, 1, 1, 0.3\n8, 0, 1, 0.3\n";
const std::string kCell = "*ELEMENT, TYPE=C3D8, ELSET=Panel\n1, 1, 2, 3, 4, 5, 6, 7, 8\n";
const std::string kMaterials =
    "*MATERIAL, NAME=Wood\n*DENSITY\n2,\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n10, 1, 0.5, 0.4, 0.4, 0.4, 0.7, 0.6\n"
    "0.1\n*MATERIAL, NAME=Foam\n*DENSITY\n1,\n*ELASTIC\n0.3, 0.2\n";
const std::string kPlies =
    "*SOLID SECTION, COMPOSITE, ELSET=Panel\n0.1, 3, Wood, 0\n0.15, 3, Foam\n0.05, 3, Wood, 60\n";

std::string deck(const std::string& section, const std::string& cell = kCell) {
  return kNodes + cell + kMaterials + section;
}

LoadedMesh read(const std::string& text) { return read_abaqus_text("panel.inp", text, FileCells::keep); }

TEST(Composites, HaveTheirPliesFromBottomToTop) {
  const LoadedMesh loaded = read(deck(kPlies));
  const std::vector<MeshPly>& plies = loaded.layups.at("Panel").plies;
  ASSERT_EQ(plies.size(), 3u);
  EXPECT_TRUE(loaded.materials.empty());
  EXPECT_EQ(plies[0].material.name, "Wood");
  EXPECT_EQ(plies[1].material.name, "Foam");
  EXPECT_EQ(plies[1].thickness, 0.15);
  EXPECT_EQ(plies[2].degrees, 60);
  EXPECT_EQ(plies[2].material.young[0], 10);
}

TEST(Composites, ThatAreSymmetricAreMirrored) {
  const auto plies = read(deck("*SOLID SECTION, COMPOSITE, SYMMETRIC, ELSET=Panel\n0.1, 3, Wood, 30\n0.05, 3, Foam\n"))
                         .layups.at("Panel")
                         .plies;
  ASSERT_EQ(plies.size(), 4u);
  EXPECT_EQ(plies[2].material.name, "Foam");
  EXPECT_EQ(plies[3].material.name, "Wood");
  EXPECT_EQ(plies[3].degrees, 30);
}

// The first ply is at the bottom of the element's stack direction, which may point against axis 3.
TEST(Composites, OfElementsThatAreUpsideDownStartAtTheTop) {
  const auto plies =
      read(deck(kPlies, "*ELEMENT, TYPE=C3D8, ELSET=Panel\n1, 5, 8, 7, 6, 1, 4, 3, 2\n")).layups.at("Panel").plies;
  EXPECT_EQ(plies[0].degrees, 60);
  EXPECT_EQ(plies[2].degrees, 0);
}

TEST(Composites, MayBeStackedAlongAnotherSideOfTheElement) {
  // The element's third direction is y; z is its first.
  const std::string cell = "*ELEMENT, TYPE=C3D8, ELSET=Panel\n1, 1, 5, 6, 2, 4, 8, 7, 3\n";
  const std::string along_first =
      "*SOLID SECTION, COMPOSITE, STACK DIRECTION=1, ELSET=Panel\n0.1, 3, Wood\n0.2, 3, Foam\n";
  EXPECT_EQ(read(deck(along_first, cell)).layups.at("Panel").plies[0].material.name, "Wood");
}

// CalculiX gives each ply an orientation.
TEST(Composites, MayHaveAnOrientationForEachPly) {
  const std::string section =
      "*ORIENTATION, NAME=Along\n0, 1, 0, -1, 0, 0\n*ORIENTATION, NAME=Turned\n1, 1, 0, -1, 1, 0\n"
      "*SOLID SECTION, COMPOSITE, ELSET=Panel\n0.1,, Wood, Along\n0.2,, Wood, Turned\n";
  const LoadedMesh loaded = read(deck(section));
  const auto& plies = loaded.layups.at("Panel").plies;
  EXPECT_EQ(plies[0].degrees, 0);
  EXPECT_NEAR(plies[1].degrees, -45, 1e-12);
  EXPECT_EQ(loaded.layups.at("Panel").axes_file, "panel.inp");
  const CellData* first = find_cell_data(loaded, "axis_1");
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->values, (std::vector<double>{0, 1, 0}));
}

TEST(Composites, AreRefusedWithTheReason) {
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_CONTAINS(refusal_of([&] { read(text); }), part);
  };
  expect(deck("*SOLID SECTION, COMPOSITE, ELSET=Panel\n"), "without plies");
  expect(deck("*SOLID SECTION, COMPOSITE, ELSET=Panel\n0, 3, Wood\n"), "thickness 0; it must be positive");
  expect(deck("*SOLID SECTION, COMPOSITE, ELSET=Panel\n0.1, 3\n"), "expected thickness, points, material");
  expect(deck("*SOLID SECTION, COMPOSITE, MATERIAL=Wood, ELSET=Panel\n0.1, 3, Wood\n"), "COMPOSITE and MATERIAL");
  expect(deck("*SOLID SECTION, COMPOSITE, STACK DIRECTION=1, ELSET=Panel\n0.1, 3, Wood\n"),
         "not stacked along axis 3 of the section's orientation");
  expect(deck("*SOLID SECTION, COMPOSITE, ELSET=Panel\n0.1, 3, Wood, None\n"), "no *ORIENTATION \"NONE\"");
  expect(deck("*ORIENTATION, NAME=A\n1, 0, 0, 0, 1, 0\n*ORIENTATION, NAME=B\n1, 0, 0, 0, 0, 1\n"
              "*SOLID SECTION, COMPOSITE, ELSET=Panel\n0.1,, Wood, A\n0.1,, Wood, B\n"),
         "does not share axis 3");
  expect(kNodes + "*ELEMENT, TYPE=C3D4, ELSET=Panel\n1, 1, 2, 4, 5\n" + kMaterials + kPlies,
         "has no stack direction 3");
}

// A scene without `materials` and `regions` takes the materials and plies of the file.
TEST(Composites, BecomeTheRegionsOfAScene) {
  const TemporaryFolder folder;
  folder.write("panel.inp", deck(kPlies));
  const std::string mesh = "mesh: {type: file, file: " + folder.path("panel.inp") + ", order: 2}\ntime: {end: 1}\n";
  const auto built = [](const std::string& text) { return build(read_scene(Config::from_text(text))); };
  const BuiltScene taken = built(mesh);
  const BuiltScene given = built(
      mesh +
      "materials:\n"
      "  wood: {type: orthotropic, density: 2, young: [10, 1, 0.5], nu12: 0.4, nu13: 0.4, nu23: 0.4, g12: 0.7, g13: "
      "0.6, g23: 0.1}\n"
      "  foam: {type: isotropic, density: 1, young: 0.3, nu: 0.2}\n"
      "regions: {Panel: {layup: [[wood, 0, 0.1], [foam, 0, 0.15], [wood, 60 deg, 0.05]]}}\n");
  ASSERT_EQ(taken.model->parts().elastic.size(), 3u);
  EXPECT_EQ(taken.model->parts().mass->total(), given.model->parts().mass->total());
  const Vector q = Vector::LinSpaced(given.model->num_dofs(), -0.01, 0.02).array().sin();
  const auto energy = [&](const BuiltScene& scene) {
    return scene.model->evaluate("energy.elastic", {0, q, Vector::Zero(q.size())})[0];
  };
  EXPECT_NEAR(energy(taken), energy(given), 1e-13 * energy(given));
}

}  // namespace
}  // namespace orthodyn::deck_layups_test
