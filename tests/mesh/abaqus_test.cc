#include "lib/mesh/io/abaqus.h"

#include <gtest/gtest.h>

#include "tests/mesh/refusal.h"
#include "tests/mesh/tets.h"

namespace orthodyn::abaqus_test {
namespace {

const std::string kDeck = R"(*Heading
two tets
** a comment
*Node, nset=All
10, 0, 0, 0
20, 1, 0, 0
30, 0, 1, 0
40, 0., 0., 1.
50, 1, 1, 1
*Element, type=C3D4, elset=Body
1, 10, 20, 30, 40
2, 20, 30,
40, 50
*Nset, nset=ends
10, 50
*Nset, nset="every second", generate
10, 50, 20
*Elset, elset=far, generate
2, 2, 1
*Surface, name=bottom, type=ELEMENT
Body, S1
*Material, name=steel
*Elastic
2e11, 0.3
*Boundary
10, 1, 3
)";

LoadedMesh load(const std::string& text) { return read_abaqus_text("body.inp", text); }
std::string refusal(const std::string& text) {
  return refusal_of([&] { load(text); });
}

TEST(Abaqus, ReadsNodesElementsAndSetsInAnyCase) {
  const Mesh mesh = load(kDeck).mesh;
  EXPECT_EQ(tets_of(mesh), (std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.node_sets.at("All").size(), 5u);
  EXPECT_EQ(mesh.node_sets.at("ends"), (std::vector<int>{0, 4}));
  EXPECT_EQ(mesh.node_sets.at("every second"), (std::vector<int>{0, 2, 4}));
}

TEST(Abaqus, TheLastSetThatNamesAnElementIsItsRegion) {
  const Mesh mesh = load(kDeck).mesh;
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"Body", "far"}));
  EXPECT_EQ(mesh.region_of, (std::vector<int>{0, 1}));
}

TEST(Abaqus, SolidSectionsDecideRegionsWhereThereAreSome) {
  const Mesh mesh = load(kDeck + "*Solid Section, elset=BODY, material=steel\n,\n").mesh;
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"Body"});
}

// Each face number gives the three nodes of Abaqus' manual; boundary faces are oriented outward.
TEST(Abaqus, FacesOfATetAreNumberedAsInItsManual) {
  const int opposite[] = {3, 2, 0, 1};  // the node that is not on S1 ... S4
  for (int side = 1; side <= 4; ++side) {
    std::string one = replaced(kDeck, "2, 20, 30,\n40, 50\n", "");
    one = replaced(replaced(one, "*Elset, elset=far, generate\n2, 2, 1\n", ""), "10, 50\n", "10\n");
    const auto faces = load(replaced(one, "Body, S1", "1, S" + std::to_string(side))).mesh.surfaces.at("bottom");
    ASSERT_EQ(faces.size(), 1u);
    int sum = 0;
    for (const int n : faces[0]) sum += n;
    EXPECT_EQ(sum, 6 - opposite[side - 1]) << side;
  }
}

TEST(Abaqus, ASurfaceOfASetHasTheFaceOfEachElement) { EXPECT_EQ(load(kDeck).mesh.surfaces.at("bottom").size(), 2u); }

TEST(Abaqus, SetsMayNameSets) {
  EXPECT_EQ(load(replaced(kDeck, "10, 50\n*", "10, 50\n*Nset, nset=both\nENDS, 20\n*")).mesh.node_sets.at("both"),
            (std::vector<int>{0, 1, 4}));
}

TEST(Abaqus, WarnsOfWhatItSkips) {
  const LoadedMesh loaded = load(kDeck);
  ASSERT_EQ(loaded.warnings.size(), 2u);
  EXPECT_CONTAINS(loaded.warnings[0], "Skipped: *BOUNDARY");
}

TEST(Abaqus, SaysWhichElementsALaterSetTakes) {
  EXPECT_CONTAINS(load(kDeck).warnings[1],
                  "body.inp: 1 elements of element set \"Body\" are also in \"far\", which comes later");
  EXPECT_EQ(load(replaced(kDeck, "*Elset, elset=far, generate\n2, 2, 1\n", "")).warnings.size(), 1u);
  EXPECT_CONTAINS(load(kDeck + "*Solid Section, elset=far\n*Solid Section, elset=Body\n").warnings[1],
                  "1 elements of element set \"far\" are also in \"Body\"");
}

TEST(Abaqus, TwoNamesOfTheSameElementsAreNoLoss) {
  const LoadedMesh loaded =
      load(replaced(kDeck, "*Elset, elset=far, generate\n2, 2, 1\n", "*Elset, elset=all\n1, 2\n"));
  EXPECT_EQ(loaded.mesh.region_names, std::vector<std::string>{"all"});
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(Abaqus, SaysWhichSetsAreNoRegionsBesideSections) {
  const auto warnings = load(kDeck + "*Elset, elset=_internal\n1\n*Solid Section, elset=Body\n").warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_CONTAINS(warnings[1], "element sets without a *SOLID SECTION do not become regions: far (1 elements)");
}

const std::string kSections = "*Solid Section, elset=Body\n*Solid Section, elset=far, orientation=Grain\n";

// Columns: axes 1, 2 and 3 of an element.
Mat3 axes_of(const LoadedMesh& loaded, Eigen::Index element) {
  const CellData &first = *find_cell_data(loaded, "axis_1"), &second = *find_cell_data(loaded, "axis_2");
  Mat3 Q;
  Q.col(0) = Eigen::Map<const Vec3>(&first.values[static_cast<std::size_t>(3 * element)]);
  Q.col(1) = Eigen::Map<const Vec3>(&second.values[static_cast<std::size_t>(3 * element)]);
  Q.col(2) = Q.col(0).cross(Q.col(1));
  return Q;
}

TEST(Abaqus, OrientationsOfSectionsAreAxesOfTheirElements) {
  // Axis 1 along y; the second point puts axis 2 into the y-z plane.
  const LoadedMesh loaded = load(kDeck + "*Orientation, name=GRAIN\n0, 2, 0, 0, 1, 3\n" + kSections);
  EXPECT_LT((axes_of(loaded, 0) - Mat3::Identity()).norm(), 1e-15);
  Mat3 expected;
  expected << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  EXPECT_LT((axes_of(loaded, 1) - expected).norm(), 1e-15);
}

TEST(Abaqus, OrientationsHaveAnOriginAndAnAngle) {
  const LoadedMesh shifted = load(kDeck + "*Orientation, name=grain\n5, 7, 5, 5, 6, 8, 5, 5, 5\n" + kSections);
  const LoadedMesh plain = load(kDeck + "*Orientation, name=grain\n0, 2, 0, 0, 1, 3\n" + kSections);
  EXPECT_LT((axes_of(shifted, 1) - axes_of(plain, 1)).norm(), 1e-15);
  // Rotation by 90 degrees about axis 3: new axis 1 = old axis 2, new axis 2 = -old axis 1.
  const LoadedMesh turned = load(kDeck + "*Orientation, name=grain\n0, 2, 0, 0, 1, 3\n3, 90.\n" + kSections);
  EXPECT_LT((axes_of(turned, 1).col(0) - axes_of(plain, 1).col(1)).norm(), 1e-15);
  EXPECT_LT((axes_of(turned, 1).col(1) + axes_of(plain, 1).col(0)).norm(), 1e-15);
  EXPECT_LT((axes_of(turned, 1).col(2) - axes_of(plain, 1).col(2)).norm(), 1e-15);
}

TEST(Abaqus, OrientationsThatAreNotReadAreNamed) {
  EXPECT_CONTAINS(
      refusal(kDeck + "*Orientation, name=Grain, system=user\n" + kSections),
      "body.inp:27: *ORIENTATION, SYSTEM=\"user\" is not supported; supported: RECTANGULAR, Z RECTANGULAR,");
  EXPECT_CONTAINS(refusal(kDeck + kSections), "body.inp:28: *SOLID SECTION: no *ORIENTATION \"GRAIN\"");
  EXPECT_CONTAINS(refusal(kDeck + "*Orientation, name=Grain\n0, 1, 0, 0, 2, 0\n" + kSections), "points are on a line");
  EXPECT_CONTAINS(refusal(kDeck + "*Orientation, name=Grain\n0, 1, 0, 0\n" + kSections), "with 4 coordinates");
  EXPECT_CONTAINS(refusal(kDeck + "*Orientation, name=Grain\n0, 1, 0, 0, 0, 1\n4, 30\n" + kSections),
                  "axis 4 of *ORIENTATION; expected 1, 2 or 3");
}

TEST(Abaqus, TakesASinglePartAsFlat) {
  std::string deck = replaced(kDeck, "*Node", "*Part, name=p\n*Node");
  deck +=
      "*End Part\n*Assembly, name=a\n*Instance, name=p-1, part=p\n*End Instance\n*Nset, nset=tip, "
      "instance=p-1\n50\n*End Assembly\n";
  EXPECT_EQ(load(deck).mesh.node_sets.at("tip"), std::vector<int>{4});
  EXPECT_CONTAINS(refusal(deck + "*Part, name=p\n"), "*PART \"p\" is defined twice");
}

struct BadDeck {
  const char *name, *from, *to, *message;
};
class RefusedAbaqus : public testing::TestWithParam<BadDeck> {};

TEST_P(RefusedAbaqus, NamesTheLineAndTheRemedy) {
  const BadDeck& bad = GetParam();
  EXPECT_CONTAINS(refusal(replaced(kDeck, bad.from, bad.to)), bad.message);
}

INSTANTIATE_TEST_SUITE_P(
    Abaqus, RefusedAbaqus,
    testing::Values(
        BadDeck{
            "cohesive", "C3D4", "COH3D6",
            "body.inp:10: element type COH3D6 is not supported; supported solid elements: tetrahedra (C3D4, C3D4H, "},
        BadDeck{"unknown_variant", "C3D4", "C3D4X", "body.inp:10: element type C3D4X is not supported"},
        BadDeck{"second_order", "C3D4", "C3D10", "element 1 ends early"},
        BadDeck{"no_coordinate", "40, 0., 0., 1.", "40, 0., zero",
                "body.inp:8: expected a coordinate (a finite number)"},
        BadDeck{"blanks_for_commas", "40, 0., 0., 1.", "40 0. 0. 1.", "body.inp:8: expected the number of a node"},
        BadDeck{"unknown_node", "40, 50\n", "40, 60\n", "body.inp:12: element 2: node 60 is not defined in *NODE"},
        BadDeck{"node_of_set", "10, 50\n*", "10, 51\n*", "body.inp:15: *NSET: node 51 is not defined"},
        BadDeck{"twice", "\n2, 20", "\n1, 20", "body.inp:12: element 1 is defined twice (first in line 11)"},
        BadDeck{"node_twice", "20, 1", "10, 1", "body.inp:6: node tag 10 is defined twice"},
        BadDeck{"face", "S1", "S5", "body.inp:21: surface \"bottom\": S5 of element 1; a tetrahedron has S1 to S4"},
        BadDeck{"face_of_none", "S1", "S7", "body.inp:21: face \"S7\"; expected S1 to S4 of a tetrahedron"},
        BadDeck{"no_face", "Body, S1", "Body", "body.inp:21: a surface of elements needs a face"},
        BadDeck{"set", "Body, S1", "Crust, S1", "body.inp:21: no *ELSET \"CRUST\""},
        BadDeck{"range", "10, 50, 20", "50, 10, 20", "the numbers must ascend"},
        BadDeck{"include", "*Elastic", "*Include, input=x.inc",
                "body.inp:23: *INCLUDE, INPUT=\"x.inc\": x.inc: cannot be opened"},
        BadDeck{"generated", "*Elastic", "*Ngen", "body.inp:23: *NGEN is not read"}),
    [](const auto& test) { return test.param.name; });

TEST(Abaqus, AHugeRangeCostsNoMoreThanItsNodes) {
  EXPECT_EQ(load(replaced(kDeck, "10, 50, 20", "10, 9000000000000000000, 20")).mesh.node_sets.at("every second").size(),
            3u);
}

// Otherwise a short line could cost a search of all nodes without counting as work.
TEST(Abaqus, NumbersThatARangeMissesAreNotFree) {
  std::string nodes = "50, 1, 1, 1\n", sets;
  for (int k = 1000; k < 7000; k += 2) nodes += std::to_string(k) + ", 2, 2, 2\n";
  nodes += "7001, 2, 2, 2\n";
  for (int k = 0; k < 200; ++k) sets += "*Nset, nset=odd, generate\n1001, 7001, 2\n";
  EXPECT_CONTAINS(refusal(replaced(kDeck, "50, 1, 1, 1\n", nodes) + sets), "more than 100 times");
}

TEST(Abaqus, ARangeOfLargeStepsCostsNoMoreThanWhatItNames) {
  std::string nodes = "50, 1, 1, 1\n", sets;
  for (int k = 1000; k < 4000; ++k) nodes += std::to_string(k) + ", 2, 2, 2\n";
  for (int k = 0; k < 200; ++k) sets += "*Nset, nset=sparse, generate\n10, 4000, 40\n";
  const Mesh mesh = load(replaced(kDeck, "50, 1, 1, 1\n", nodes) + sets).mesh;
  EXPECT_EQ(mesh.node_sets.at("sparse"), (std::vector<int>{0, 4}));
}

}  // namespace
}  // namespace orthodyn::abaqus_test
