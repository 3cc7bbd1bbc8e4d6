#include "lib/mesh/io/gmsh.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "lib/mesh/io/mesh_file.h"
#include "tests/mesh/gmsh_test_file.h"
#include "tests/mesh/tets.h"

namespace orthodyn::gmsh_test {
namespace {

LoadedMesh load(const std::string& content) { return read_gmsh(TemporaryFile(content).path()); }

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.region_of, b.region_of);
  EXPECT_EQ(a.region_names, b.region_names);
  EXPECT_EQ(a.surfaces, b.surfaces);
}

TEST(Gmsh, ReadsNodesTetsRegionsAndSurfaces) {
  const auto [mesh, warnings, materials, layups, cell_data] = load(kFile22);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(mesh.nodes, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}));
  EXPECT_EQ(tets_of(mesh), (std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"left", "right side"}));
  EXPECT_EQ(mesh.region_of, (std::vector<int>{0, 1}));
  ASSERT_EQ(mesh.surfaces.size(), 1u);
  EXPECT_EQ(mesh.surfaces.at("load"), (std::vector<FaceCorners>{{0, 2, 1}}));
}

TEST(Gmsh, BothFormatsOfAMeshGiveTheSame) { expect_same(load(kFile22).mesh, load(kFile41).mesh); }

TEST(Gmsh, ReadsLinesThatEndWithCarriageReturns) {
  for (const std::string& file : {kFile22, kFile41}) {
    std::string dos;
    for (char c : file) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
    expect_same(load(dos).mesh, load(file).mesh);
  }
}

TEST(Gmsh, ReadsAFileWithoutANewlineAtItsEnd) {
  for (const std::string& file : {kFile22, kFile41}) {
    expect_same(load(file.substr(0, file.size() - 1)).mesh, load(file).mesh);
  }
}

TEST(Gmsh, ReadsBlankLinesTabsAndTrailingBlanks) {
  std::string file = replaced(kFile22, "2 1 0 0\n", "\n  2\t1 0  0 \t\n \n\n");
  expect_same(load(file).mesh, load(kFile22).mesh);
}

TEST(Gmsh, NumbersNodesByAscendingTagWhateverTheirOrder) {
  std::string file = replaced(kFile22, "1 0 0 0\n2 1 0 0\n", "2 1 0 0\n1 0 0 0\n");
  expect_same(load(file).mesh, load(kFile22).mesh);
}

TEST(Gmsh, ReadsSparseAndHugeTags) {
  std::string file = replaced(kFile22, "5 1 1 1\n", "9000000000000000000 1 1 1\n");
  file = replaced(file, "5 4 2 2 2 2 3 4 5", "8000000000000000000 4 2 2 2 2 3 4 9000000000000000000");
  expect_same(load(file).mesh, load(kFile22).mesh);
}

TEST(Gmsh, ReadsNumbersInAnyNotation) {
  const Mesh mesh = load(replaced(kFile22, "2 1 0 0\n", "+2 +1.0E+00 -0 0e5\n")).mesh;
  EXPECT_EQ(mesh.nodes[1], Vec3(1, 0, 0));
}

TEST(Gmsh, SkipsUnknownSections) {
  const std::string extra = "$Periodic\nany 1 thing\n$EndPeriodic\n";
  expect_same(load(replaced(kFile22, "$Nodes", extra + "$Nodes")).mesh, load(kFile22).mesh);
  expect_same(load("$Comments\nhello\n$EndComments\n" + kFile41 + extra).mesh, load(kFile41).mesh);
}

TEST(Gmsh, ReadsElementsBeforeNodesInFormat22) {
  const std::size_t nodes = kFile22.find("$Nodes"), elements = kFile22.find("$Elements");
  const std::string file =
      kFile22.substr(0, nodes) + kFile22.substr(elements) + kFile22.substr(nodes, elements - nodes);
  expect_same(load(file).mesh, load(kFile22).mesh);
}

TEST(Gmsh, NamesGroupsWithoutANameByTheirTag) {
  for (const std::string& file : {kFile22, kFile41}) {
    const std::size_t begin = file.find("$PhysicalNames");
    const std::string end = "$EndPhysicalNames\n";
    std::string unnamed = file;
    unnamed.erase(begin, file.find(end) + end.size() - begin);
    const Mesh mesh = load(unnamed).mesh;
    EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"volume1", "volume2"}));
    EXPECT_TRUE(mesh.surfaces.contains("surface5"));
  }
}

TEST(Gmsh, KeepsQuotesAndBlanksInNames) {
  const Mesh mesh = load(replaced(kFile22, "\"right side\"", "\"a \"b\" c\" ")).mesh;
  EXPECT_EQ(mesh.region_names[1], "a \"b\" c");
}

TEST(Gmsh, VolumesOfTheSameNameAreOneRegion) {
  const Mesh mesh = load(replaced(kFile22, "\"right side\"", "\"left\"")).mesh;
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"left"});
  EXPECT_EQ(mesh.region_of, (std::vector<int>{0, 0}));
}

TEST(Gmsh, TetsWithoutAnyPhysicalVolumeFormTheBody) {
  std::string file = replaced(kFile22, "4 4 2 1 1", "4 4 0");
  file = replaced(file, "5 4 2 2 2", "5 4 2 0 2");
  file = replaced(file, "3\n2 5 \"load\"\n3 1 \"left\"\n3 2 \"right side\"", "1\n2 5 \"load\"");
  const auto [mesh, warnings, materials, layups, cell_data] = load(file);
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"body"});
  EXPECT_TRUE(warnings.empty());
}

TEST(Gmsh, WarnsIfOnlySomeTetsHaveAPhysicalVolume) {
  for (const std::string& file :
       {replaced(kFile22, "5 4 2 2 2", "5 4 2 0 2"), replaced(kFile41, "2 0 0 0 1 1 1 1 2 0", "2 0 0 0 1 1 1 0 0")}) {
    const auto [mesh, warnings, materials, layups, cell_data] =
        load(replaced(file, "3\n2 5 \"load\"\n3 1 \"left\"\n3 2 \"right side\"", "2\n2 5 \"load\"\n3 1 \"left\""));
    EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"body", "left"}));
    EXPECT_EQ(mesh.region_of, (std::vector<int>{1, 0}));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("1 of 2 elements are in no physical volume"), std::string::npos);
  }
}

TEST(Gmsh, WarnsOfNamedGroupsWithoutElements) {
  const auto [mesh, warnings, materials, layups, cell_data] = load(replaced(kFile22, "3\n2 5", "4\n2 8 \"hole\"\n2 5"));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("physical surface \"hole\" has no faces"), std::string::npos);
}

TEST(Gmsh, PhysicalCurvesAndPointsAreNodeSets) {
  std::string old = replaced(kFile22, "3\n2 5", "5\n0 9 \"tip\"\n1 8 \"edge\"\n2 5");
  old = replaced(replaced(old, "1 15 2 0 1 1", "1 15 2 9 1 1"), "2 1 2 0 1 1 2", "2 1 2 8 1 1 2");
  std::string file41 = replaced(kFile41, "3\n2 5", "5\n0 9 \"tip\"\n1 8 \"edge\"\n2 5");
  file41 = replaced(replaced(file41, "1 0 0 0 0\n", "1 0 0 0 1 9\n"), "1 0 0 0 1 0 0 0 2", "1 0 0 0 1 0 0 1 8 2");
  for (const std::string& file : {old, file41}) {
    const LoadedMesh loaded = load(file);
    EXPECT_EQ(loaded.mesh.node_sets.at("edge"), (std::vector<int>{0, 1}));
    EXPECT_EQ(loaded.mesh.node_sets.at("tip"), std::vector<int>{0});
    EXPECT_TRUE(loaded.warnings.empty());
  }
  const auto empty = load(replaced(kFile22, "3\n2 5", "4\n1 8 \"edge\"\n2 5")).warnings;
  ASSERT_EQ(empty.size(), 1u);
  EXPECT_NE(empty[0].find("physical curve \"edge\" has no lines of first or second order"), std::string::npos);
}

TEST(Gmsh, WarnsOfNodesThatNoElementUses) {
  const auto [mesh, warnings, materials, layups, cell_data] =
      load(replaced(kFile22, "5\n1 0 0 0\n", "6\n77 9 9 9\n1 0 0 0\n"));
  EXPECT_EQ(mesh.nodes.size(), 5u);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("beam.msh:12: node 77"), std::string::npos) << warnings[0];
}

TEST(Gmsh, ATriangleBelongsToAllPhysicalSurfacesOfItsEntity) {
  const Mesh mesh = load(replaced(kFile41, "1 0 1 5 1 1", "1 0 2 5 6 1 1")).mesh;
  EXPECT_EQ(mesh.surfaces.at("load"), mesh.surfaces.at("surface6"));
}

TEST(Gmsh, PhysicalPointsBecomeNodeSets) {
  const std::string v22 = replaced(kFile22, "1 15 2 0 1 1", "1 15 2 7 1 3");
  const std::string v41 = replaced(replaced(kFile41, "1 0 0 0 0\n", "1 0 0 0 1 7\n"), "\n1 1\n", "\n1 3\n");
  for (const std::string& file : {v22, v41}) {
    EXPECT_EQ(load(file).mesh.node_sets.at("points7"), std::vector<int>{2});
    EXPECT_TRUE(load(replaced(file, "3\n2 5", "4\n0 7 \"tip\"\n2 5")).mesh.node_sets.contains("tip"));
  }
}

// Format 2.2 has such a triangle reversed, 4.1 marks the group by a negative tag.
TEST(Gmsh, ANegativePhysicalTagTurnsInnerTrianglesOver) {
  const std::string inner = replaced(kFile41, "\n3 1 3 2\n", "\n3 2 3 4\n");
  const std::string reversed = replaced(inner, "1 0 1 5 1 1", "1 0 1 -5 1 1");
  EXPECT_EQ(load(inner).mesh.surfaces.at("load"), (std::vector<FaceCorners>{{1, 2, 3}}));
  EXPECT_EQ(load(reversed).mesh.surfaces.at("load"), (std::vector<FaceCorners>{{1, 3, 2}}));
}

TEST(Gmsh, TurnsBoundaryTrianglesOutward) {
  const Mesh mesh = load(replaced(kFile22, "1 1 3 2\n", "1 1 2 3\n")).mesh;
  EXPECT_EQ(mesh.surfaces.at("load"), (std::vector<FaceCorners>{{0, 2, 1}}));
}

TEST(Gmsh, ReadsFormat41WithoutEntitiesAsOneBody) {
  std::string file = kFile41;
  const std::string end = "$EndEntities\n";
  file.erase(file.find("$Entities"), file.find(end) + end.size() - file.find("$Entities"));
  const Mesh mesh = load(file).mesh;
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"body"});
  EXPECT_TRUE(mesh.surfaces.empty());
}

TEST(Gmsh, IgnoresParametricCoordinates) {
  std::string file = replaced(kFile41, "3 1 0 4\n", "2 1 1 4\n");
  file = replaced(file, "1 0 0\n0 1 0\n0 0 1\n1 1 1\n", "1 0 0 7 7\n0 1 0 7 7\n0 0 1 7 7\n1 1 1 7 7\n");
  expect_same(load(file).mesh, load(kFile41).mesh);
}

TEST(Gmsh, IgnoresUnboundedBoxesOfEntities) {
  const std::string file = replaced(kFile41, "1 0 0 0 1 0 0 0 2 1 -1", "1 1e999 inf 0 -1e999 0 0 0 0");
  expect_same(load(file).mesh, load(kFile41).mesh);
}

TEST(Gmsh, BothFormatsOfTheReferenceMeshesGiveTheSame) {
  const char* data = std::getenv("ORTHODYN_DATA");
  if (data == nullptr) GTEST_SKIP() << "ORTHODYN_DATA is not set";
  for (const std::string name : {"beam", "strip"}) {
    const std::string start = std::string(data) + "/reference/meshes/" + name;
    const LoadedMesh v22 = read_gmsh(start + ".v22.msh");
    expect_same(v22.mesh, read_gmsh(start + ".v41.msh").mesh);
    EXPECT_TRUE(v22.warnings.empty());
    EXPECT_FALSE(v22.mesh.surfaces.empty());
  }
}

TEST(Gmsh, NamesInLatin1BecomeUtf8WithAWarning) {
  const TemporaryFile file(replaced(replaced(kFile22, "\"left\"", "\"Tr\xE4ger\""), "\"load\"", "\"B\xFCgel\""));
  const LoadedMesh loaded = read_mesh(file.path());
  EXPECT_EQ(loaded.mesh.region_names[0], "Tr\u00e4ger");
  EXPECT_TRUE(loaded.mesh.surfaces.contains("B\u00fcgel"));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_CONTAINS(loaded.warnings[0], "read as Latin-1: Tr\u00e4ger, B\u00fcgel");
}

}  // namespace
}  // namespace orthodyn::gmsh_test
