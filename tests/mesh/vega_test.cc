#include "lib/mesh/io/vega.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "lib/core/errors.h"
#include "tests/mesh/refusal.h"
#include "tests/mesh/tets.h"

namespace orthodyn::vega_test {
namespace {

const std::string kTwoTets = R"(# two tets
*VERTICES
5 3 0 0
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1

*ELEMENTS
TET
2 4 0
1 1 2 3 4
2 2, 3, 4, 5
)";

const std::string kRegions = kTwoTets + R"(
*SET core
2
*MATERIAL hard
ENU, 1000, 2e6, 0.25
*MATERIAL soft wood
ORTHOTROPIC_N1, 400, 1e9, 4e8, 1e8, 0.3
*REGION
allElements, hard
*REGION
core, softwood
)";

LoadedMesh load(const std::string& text) { return read_vega_text("body.veg", text); }
std::string refusal(const std::string& text) {
  return refusal_of([&] { load(text); });
}

MeshMaterial material(const std::string& line) {
  return load(kTwoTets + "*MATERIAL m\n" + line + "\n*REGION\nallElements, m\n").materials.at("allElements");
}
std::string refused_material(const std::string& line) {
  return refusal(kTwoTets + "*MATERIAL m\n" + line + "\n*REGION\nallElements, m\n");
}

TEST(Vega, ReadsVerticesAndTets) {
  const LoadedMesh loaded = load(kTwoTets);
  EXPECT_EQ(loaded.mesh.nodes, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}));
  EXPECT_EQ(tets_of(loaded.mesh), (std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(loaded.mesh.region_names, std::vector<std::string>{"body"});
  EXPECT_TRUE(loaded.materials.empty());
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(Vega, CountsFromZeroIfTheFirstNumberIsZero) {
  std::string zero =
      "*VERTICES\n5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 1\n*ELEMENTS\nTETS\n2 4 0\n"
      "0 0 1 2 3\n1 1 2 3 4\n*SET second\n1\n";
  const LoadedMesh loaded = load(zero);
  EXPECT_EQ(loaded.mesh.cells, load(kTwoTets).mesh.cells);
  EXPECT_EQ(loaded.mesh.region_of[1], 0);  // regions in the order of the file, the rest last
  EXPECT_EQ(loaded.mesh.region_names[0], "second");
}

TEST(Vega, RegionsAreNamedAfterTheirSetsAndTheLaterOneWins) {
  const LoadedMesh loaded = load(kRegions);
  EXPECT_EQ(loaded.mesh.region_names, (std::vector<std::string>{"allElements", "core"}));
  EXPECT_EQ(loaded.mesh.region_of, (std::vector<int>{0, 1}));
  EXPECT_EQ(loaded.materials.at("allElements").name, "hard");
  EXPECT_EQ(loaded.materials.at("core").name, "softwood");
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_CONTAINS(loaded.warnings[0], "\"core\" takes 1 elements");
}

TEST(Vega, SetsAreTheRegionsOfAFileWithoutRegions) {
  const LoadedMesh loaded = load(kTwoTets + "*SET left\n1,\n*SET right\n2\n");
  EXPECT_EQ(loaded.mesh.region_names, (std::vector<std::string>{"left", "right"}));
  EXPECT_TRUE(loaded.materials.empty());
}

TEST(Vega, ASecondSetOfANameGoesOnWithTheFirst) {
  const LoadedMesh loaded = load(kTwoTets + "*SET all\n1\n*SET all\n2\n");
  EXPECT_EQ(loaded.mesh.region_names, std::vector<std::string>{"all"});
  EXPECT_EQ(loaded.mesh.region_of, (std::vector<int>{0, 0}));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_CONTAINS(loaded.warnings[0], "body.veg:17: a second *SET \"all\": its elements are added to those of line 15");
}

TEST(Vega, ASetOfNoRegionIsNamed) {
  const LoadedMesh loaded =
      load(kTwoTets + "*SET a\n1\n*SET b\n1, 2\n*MATERIAL m\nENU, 1, 1, 0\n*REGION\nallElements, m\n");
  ASSERT_EQ(loaded.warnings.size(), 2u);
  EXPECT_CONTAINS(loaded.warnings[0], "body.veg:15: *SET \"a\" of 1 elements is in no *REGION, and is left out");
  EXPECT_CONTAINS(loaded.warnings[1], "body.veg:17: *SET \"b\" of 2 elements is in no *REGION, and is left out");
}

TEST(Vega, ElementsInNoRegionAreNamedAndHaveNoMaterial) {
  const LoadedMesh loaded = load(kTwoTets + "*SET a\n1\n*MATERIAL m\nENU, 1, 1, 0\n*REGION\na, m\n");
  EXPECT_EQ(loaded.mesh.region_names, (std::vector<std::string>{"a", "unassigned"}));
  EXPECT_FALSE(loaded.materials.contains("unassigned"));
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(Vega, ENuIsDensityYoungAndPoisson) {
  const MeshMaterial m = material("ENU, 1000, 2e6, 0.25");
  EXPECT_EQ(m.kind, MeshMaterial::Kind::isotropic);
  EXPECT_EQ(m.density, 1000);
  EXPECT_EQ(m.young, Vec3::Constant(2e6));
  EXPECT_EQ(m.nu12, 0.25);
}

TEST(Vega, ThreeRatiosAreTakenAsTheyStand) {
  for (const std::string kind : {"ORTHOTROPIC", "ORTHOTROPIC_N3G3R9"}) {
    const MeshMaterial m = material(kind + ", 400, 3, 2, 1, .12, .23, .31, 12, 23, 31, 0,-1,0, 1,0,0, 0,0,1");
    EXPECT_EQ(m.young, Vec3(3, 2, 1));
    EXPECT_EQ((Vec3{m.nu12, m.nu23, m.nu31}), Vec3(.12, .23, .31));
    EXPECT_EQ((Vec3{m.g12, m.g23, m.g31}), Vec3(12, 23, 31));
    EXPECT_EQ(m.axes.col(0), Vec3(0, 1, 0));  // the axes are the columns of R, whose rows are written
    EXPECT_EQ(m.axes.col(1), Vec3(-1, 0, 0));
  }
  EXPECT_EQ(material("ORTHOTROPIC_N3G3, 400, 3, 2, 1, .12, .23, .31, 12, 23, 31").axes, Mat3::Identity());
}

// nu_ij / E_i = nu_ji / E_j must hold for all pairs, G_ij = factor sqrt(E_i E_j) / (2 (1 + nu)).
TEST(Vega, OneRatioGivesTheStableFamily) {
  for (const std::string line :
       {"_N1, 400, 8, 4, 2, 0.3", "_N1G1, 400, 8, 4, 2, 0.3, 1.5", "_N1R9, 400, 8, 4, 2, 0.3, 1,0,0, 0,1,0, 0,0,1",
        "_N1G1R9, 400, 8, 4, 2, 0.3, 1.5, 1,0,0, 0,1,0, 0,0,1"}) {
    const MeshMaterial m = material("ORTHOTROPIC" + line);
    const double factor = line.find("G1") == std::string::npos ? 1 : 1.5;
    EXPECT_NEAR(m.nu12, 0.3 * std::sqrt(2), 1e-15);
    EXPECT_NEAR(m.nu23, 0.3 * std::sqrt(2), 1e-15);
    EXPECT_NEAR(m.nu31, 0.3 / 2, 1e-15);
    EXPECT_NEAR(m.g12 * 2.6 / factor, std::sqrt(32), 1e-13);
    EXPECT_NEAR(m.g23 * 2.6 / factor, std::sqrt(8), 1e-13);
    EXPECT_NEAR(m.g31 * 2.6 / factor, 4, 1e-13);
  }
}

TEST(Vega, RefusesAxesThatAreNotOrthonormalAndRepairsRounding) {
  EXPECT_CONTAINS(refused_material("ORTHOTROPIC_N1R9, 1, 1, 1, 1, 0, 1,0.1,0, 0,1,0, 0,0,1"),
                  "body.veg:16: the axes R are not orthonormal: rows (1, 0.1, 0), (0, 1, 0), (0, 0, 1)");
  const Mat3 Q = material("ORTHOTROPIC_N1R9, 1, 1, 1, 1, 0, 0.6,-0.8,0, 0.80000001,0.6,0, 0,0,1").axes;
  EXPECT_LT((Q.transpose() * Q - Mat3::Identity()).norm(), 1e-15);
  EXPECT_LT((Q.col(0) - Vec3(0.6, 0.8, 0)).norm(), 2e-8);
}

TEST(Vega, TurnsOneAxisOfALeftHandedSystem) {
  EXPECT_EQ(material("ORTHOTROPIC_N1R9, 1, 1, 1, 1, 0, 1,0,0, 0,1,0, 0,0,-1").axes, Mat3::Identity());
}

TEST(Vega, FixedVerticesCountFromOneAndBecomeANodeSet) {
  const TemporaryFolder folder;
  folder.write("body.veg", kTwoTets);
  folder.write("body.bou", "1,3,\n5,\n");
  EXPECT_EQ(read_vega(folder.path("body.veg"), {folder.path("body.bou")}).mesh.node_sets.at("fixed"),
            (std::vector<int>{0, 2, 4}));
  folder.write("body.bou", "1,\n0,6\n");
  EXPECT_CONTAINS(refusal_of([&] { read_vega(folder.path("body.veg"), {folder.path("body.bou")}); }),
                  "body.bou:2: vertex 0; the mesh has 1 to 5");
}

TEST(Vega, IncludesFilesRelativeToTheirOwnPlace) {
  const TemporaryFolder folder;
  folder.write("body.veg", kTwoTets + "*SET part\n*INCLUDE list.txt\n");
  folder.write("list.txt", "1,\n7\n");
  EXPECT_CONTAINS(refusal_of([&] { read_vega(folder.path("body.veg")); }),
                  "list.txt:2: set \"part\": element 7; there are 1 to 2");
  folder.write("list.txt", "1, 2\n");
  EXPECT_EQ(read_vega(folder.path("body.veg")).mesh.region_names, std::vector<std::string>{"part"});
  folder.write("list.txt", "*INCLUDE list.txt\n");
  EXPECT_CONTAINS(refusal_of([&] { read_vega(folder.path("body.veg")); }), "list.txt:1: \"list.txt\" includes itself");
}

TEST(Vega, AFileThatIncludesItselfUnderAnotherSpellingIsRefusedAtOnce) {
  const TemporaryFolder folder;
  folder.write("body.veg", kTwoTets + "*INCLUDE ./body.veg\n");
  EXPECT_CONTAINS(refusal_of([&] { read_vega(folder.path("body.veg")); }), "\"./body.veg\" includes itself");
  std::filesystem::create_symlink(folder.path("body.veg"), folder.path("link.veg"));
  folder.write("body.veg", kTwoTets + "*INCLUDE link.veg\n");
  EXPECT_CONTAINS(refusal_of([&] { read_vega(folder.path("body.veg")); }), "\"link.veg\" includes itself");
}

TEST(Vega, FilesIncludedAgainAndAgainAreBoundedByTheirSize) {
  const TemporaryFolder folder;
  std::string many;
  for (int k = 0; k < 50; ++k) many += "*INCLUDE list.txt\n";
  folder.write("list.txt", std::string(200'000, ' ') + "1\n");
  folder.write("body.veg", kTwoTets + "*SET part\n" + many);
  EXPECT_CONTAINS(refusal_of([&] { read_vega(folder.path("body.veg")); }), "10 times the size of the files");
  folder.write("list.txt", "1\n");
  EXPECT_EQ(read_vega(folder.path("body.veg")).mesh.region_names.front(), "part");
}

TEST(Vega, NamesThatNoFileCanHaveAreRefused) {
  EXPECT_CONTAINS(refusal(kTwoTets + "*INCLUDE " + std::string(5000, 'a') + "\n"), "no such file");
}

struct BadVega {
  const char *name, *from, *to, *message;
};
class RefusedVega : public testing::TestWithParam<BadVega> {};

TEST_P(RefusedVega, NamesTheLineAndTheRemedy) {
  const BadVega& bad = GetParam();
  EXPECT_CONTAINS(refusal(replaced(kRegions, bad.from, bad.to)), bad.message);
}

INSTANTIATE_TEST_SUITE_P(
    Vega, RefusedVega,
    testing::Values(
        BadVega{"triangles", "TET", "TRI", "body.veg:11: element type \"TRI\"; expected TET or CUBIC"},
        BadVega{"few_vertices", "5 3 0 0", "6 3 0 0", "body.veg:10: 5 of the 6 vertices announced after line 2"},
        BadVega{"many_vertices", "5 3 0 0", "4 3 0 0", "body.veg:8: more than the 4 vertices announced after line 2"},
        BadVega{"few_elements", "2 4 0", "3 4 0", "body.veg:16: 2 of the 3 elements"},
        BadVega{"gap", "3 0 1 0", "7 0 1 0", "body.veg:6: vertex 7 where 3 is expected"},
        BadVega{"unknown_vertex", "3, 4, 5", "3, 4, 6", "body.veg:14: element 2: node 6 is not defined in *VERTICES"},
        BadVega{"word", "0 0 1", "0 0 up", "body.veg:7: expected a coordinate (a finite number), found \"up\""},
        BadVega{"no_material", "core, softwood", "core, hardwood", "body.veg:25: no *MATERIAL \"hardwood\""},
        BadVega{"no_set", "core, soft", "crust, soft", "body.veg:25: no *SET \"crust\""},
        BadVega{"element_of_set", "core\n2", "core\n3", "body.veg:17: set \"core\": element 3; there are 1 to 2"},
        BadVega{"mooney", "ENU,", "MOONEYRIVLIN,", "is not supported; supported: ENU and ORTHOTROPIC"},
        BadVega{"form", "_N1,", "_N2,", "the forms of ORTHOTROPIC are"},
        BadVega{"too_few_constants", "1e8, 0.3", "1e8", "body.veg:21: expected nu, found the end of the line"},
        BadVega{"negative", "2e6", "-2e6", "body.veg:19: E is -2000000; it must be positive"},
        BadVega{"keyword", "*SET", "*SETS", "body.veg:16: unknown keyword \"*SETS\""},
        BadVega{"include", "core\n2", "core\n*INCLUDE x.txt", "*INCLUDE \"x.txt\": no such file: x.txt"},
        BadVega{"second", "*SET core\n2", "*VERTICES", "body.veg:16: a second *VERTICES"}),
    [](const auto& test) { return test.param.name; });

TEST(Vega, RefusesTruncatedFiles) {
  EXPECT_CONTAINS(refusal(""), "without *VERTICES");
  EXPECT_CONTAINS(refusal(kTwoTets.substr(0, kTwoTets.find("*ELEMENTS"))), "without *ELEMENTS");
  EXPECT_CONTAINS(refusal(kTwoTets.substr(0, kTwoTets.find("2 2, 3"))), "1 of the 2 elements");
  EXPECT_CONTAINS(refusal("hello"), "this is not a Vega mesh file");
}

TEST(Vega, ReadsTheModelsThatComeWithVega) {
  const char* data = std::getenv("ORTHODYN_DATA");
  const std::string veg = std::string(data ? data : "") + "/veg/";
  if (!data || !std::filesystem::exists(veg)) GTEST_SKIP() << "ORTHODYN_DATA/veg is absent";
  const LoadedMesh turtle =
      read_vega(veg + "turtle/turtle-volumetric-heterogeneous.ortho.veg", {veg + "turtle/turtle-volumetric.bou"});
  EXPECT_EQ(turtle.mesh.nodes.size(), 347u);
  EXPECT_EQ(turtle.mesh.cells.size(), 1185u);
  EXPECT_EQ(turtle.materials.at("theRest").young, Vec3(25e9, 25e5, 25e3));
  EXPECT_TRUE(turtle.mesh.node_sets.contains("fixed"));
  EXPECT_EQ(read_vega(veg + "simple_bridge/simpleBridge-ic_128_0.15_.1.veg").mesh.cells.size(), 12827u);
  const LoadedMesh cubes = read_vega(veg + "simple_bridge/simpleBridge_resol92-b1.155_enlarged.veg", FileCells::split);
  EXPECT_EQ(cubes.mesh.cell_of.back(), 1735);
  EXPECT_CONTAINS(cubes.warnings.at(0), "1736 hexahedra are split into ");
  double volume = 0;
  for (const Tet& tet : tets_of(cubes.mesh)) volume += signed_volume6(cubes.mesh, tet) / 6;
  const double edge = (cubes.mesh.nodes[1] - cubes.mesh.nodes[0]).norm();
  EXPECT_NEAR(volume, 1736 * edge * edge * edge, 1e-4 * volume);  // coordinates have six digits
}

}  // namespace
}  // namespace orthodyn::vega_test
