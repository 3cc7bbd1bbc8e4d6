#include "lib/mesh/io/abaqus.h"

#include <gtest/gtest.h>

#include "tests/mesh/refusal.h"

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
)";

LoadedMesh load(const std::string& text) { return read_abaqus_text("body.inp", text); }
std::string refusal(const std::string& text) {
  return refusal_of([&] { load(text); });
}

TEST(Abaqus, ReadsNodesElementsAndSetsInAnyCase) {
  const TetMesh mesh = load(kDeck).mesh;
  EXPECT_EQ(mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.node_sets.at("All").size(), 5u);
  EXPECT_EQ(mesh.node_sets.at("ends"), (std::vector<int>{0, 4}));
  EXPECT_EQ(mesh.node_sets.at("every second"), (std::vector<int>{0, 2, 4}));
}

TEST(Abaqus, TheLastSetThatNamesAnElementIsItsRegion) {
  const TetMesh mesh = load(kDeck).mesh;
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"Body", "far"}));
  EXPECT_EQ(mesh.region_of, (std::vector<int>{0, 1}));
}

TEST(Abaqus, SolidSectionsDecideRegionsWhereThereAreSome) {
  const TetMesh mesh = load(kDeck + "*Solid Section, elset=BODY, material=steel\n,\n").mesh;
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"Body"});
}

// Each face has the three nodes that its number says; the boundary turns them outward.
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

TEST(Abaqus, ASurfaceOfASetHasTheFaceOfEachElement) {
  EXPECT_EQ(load(kDeck).mesh.surfaces.at("bottom").size(), 2u);
}

TEST(Abaqus, SetsMayNameSets) {
  EXPECT_EQ(load(replaced(kDeck, "10, 50\n*", "10, 50\n*Nset, nset=both\nENDS, 20\n*")).mesh.node_sets.at("both"),
            (std::vector<int>{0, 1, 4}));
}

TEST(Abaqus, WarnsOfWhatItSkips) {
  const LoadedMesh loaded = load(kDeck);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_CONTAINS(loaded.warnings[0], "only the mesh is read; skipped: *ELASTIC, *MATERIAL");
}

TEST(Abaqus, TakesASinglePartAsFlat) {
  std::string deck = replaced(kDeck, "*Node", "*Part, name=p\n*Node");
  deck +=
      "*End Part\n*Assembly, name=a\n*Instance, name=p-1, part=p\n*End Instance\n*Nset, nset=tip, "
      "instance=p-1\n50\n*End Assembly\n";
  EXPECT_EQ(load(deck).mesh.node_sets.at("tip"), std::vector<int>{4});
  EXPECT_CONTAINS(refusal(replaced(deck, "part=p\n", "part=p\n1, 0, 0\n")), "an instance that is moved");
  EXPECT_CONTAINS(refusal(deck + "*Part, name=q\n"), "a second *PART; only one is read");
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
        BadDeck{"cohesive", "C3D4", "COH3D6",
                "body.inp:10: elements of type COH3D6; solid elements that are read: tetrahedra (C3D4, C3D4H, "},
        BadDeck{"unknown_variant", "C3D4", "C3D4X", "body.inp:10: elements of type C3D4X; solid elements"},
        BadDeck{"second_order", "C3D4", "C3D10", "element 1 ends early"},
        BadDeck{"two_dimensions", "40, 0., 0., 1.", "40, 0., 0.", "body.inp:8: expected a coordinate, found the end"},
        BadDeck{"unknown_node", "40, 50\n", "40, 60\n", "body.inp:12: element 2: node 60 is not defined in *NODE"},
        BadDeck{"node_of_set", "10, 50\n*", "10, 51\n*", "body.inp:15: *NSET: node 51 is not defined"},
        BadDeck{"twice", "\n2, 20", "\n1, 20", "body.inp:12: element 1 is defined twice (first in line 11)"},
        BadDeck{"node_twice", "20, 1", "10, 1", "body.inp:6: node tag 10 is defined twice"},
        BadDeck{"face", "S1", "S5", "body.inp:21: surface \"bottom\": S5 of element 1; a tetrahedron has S1 to S4"},
        BadDeck{"face_of_none", "S1", "S7", "body.inp:21: face \"S7\"; expected S1 to S4 of a tetrahedron"},
        BadDeck{"no_face", "Body, S1", "Body", "body.inp:21: a surface of elements without a face"},
        BadDeck{"set", "Body, S1", "Crust, S1", "body.inp:21: no *ELSET \"CRUST\""},
        BadDeck{"range", "10, 50, 20", "50, 10, 20", "the numbers must ascend"},
        BadDeck{"include", "*Elastic", "*Include, input=x", "body.inp:23: *INCLUDE is not read"},
        BadDeck{"generated", "*Elastic", "*Ngen", "body.inp:23: *NGEN is not read"}),
    [](const auto& test) { return test.param.name; });

TEST(Abaqus, AHugeRangeCostsNoMoreThanItsNodes) {
  EXPECT_EQ(load(replaced(kDeck, "10, 50, 20", "10, 9000000000000000000, 20")).mesh.node_sets.at("every second").size(),
            3u);
}

// Otherwise a short line costs a walk through all nodes and is free.
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
  const TetMesh mesh = load(replaced(kDeck, "50, 1, 1, 1\n", nodes) + sets).mesh;
  EXPECT_EQ(mesh.node_sets.at("sparse"), (std::vector<int>{0, 4}));
}

}  // namespace
}  // namespace orthodyn::abaqus_test
