// Abaqus input files with other coordinate systems, included files, nested sets, shells, instances, and axes by
// element.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/core/spelling.h"
#include "lib/mesh/io/abaqus.h"
#include "tests/mesh/refusal.h"

namespace orthodyn::abaqus_deck_test {
namespace {

// Two bricks, one on top of the other.
const std::string kNodes = R"(1, 0., 0., 0.
2, 1.
3, 1., 1.
4, , 1.,
5, 0., 0., 1D0
6, 1., , 1.
7, 1., 1., 1.
8, 0., 1., 1.
9, 0., 0., 2.
10, 1., 0., 2.
11, 1., 1., 2.
12, 0., 1., 2.
)";
const std::string kElements = "1, 1,2,3,4,5,6,7,8\n2, 5,6,7,8,9,10,11,12\n";
const std::string kDeck = "*NODE, NSET=NALL\n" + kNodes + "*ELEMENT, TYPE=C3D8, ELSET=ALL\n" + kElements;

LoadedMesh load(const std::string& text) { return read_abaqus_text("body.inp", text); }
std::string refusal(const std::string& text) {
  return refusal_of([&] { load(text); });
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) sum += cell_volume(mesh, e);
  return sum;
}

TEST(AbaqusDeck, CoordinatesThatAreLeftOutAreZero) {
  const Mesh mesh = load(kDeck).mesh;
  EXPECT_EQ(mesh.nodes[1], Vec3(1, 0, 0));
  EXPECT_EQ(mesh.nodes[3], Vec3(0, 1, 0));
  EXPECT_EQ(mesh.nodes[4], Vec3(0, 0, 1));
  EXPECT_EQ(mesh.nodes[5], Vec3(1, 0, 1));
  EXPECT_NEAR(volume(mesh), 2, 1e-15);
}

// An azimuth of 90 degrees is the y axis; the second angle of a sphere is the elevation above the x-y plane.
TEST(AbaqusDeck, NodesMayBeInCylindricalOrSphericalCoordinates) {
  const std::string element = "*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1,2,3,4\n";
  const Mesh cylinder = load("*NODE, SYSTEM=C\n1, 1., 0., 0.\n2, 2.\n3, 2., 90.\n4, 1., 0., 1.\n" + element).mesh;
  EXPECT_EQ(cylinder.nodes[2], Vec3(0, 2, 0));
  EXPECT_EQ(cylinder.nodes[3], Vec3(1, 0, 1));
  const Mesh sphere = load("*NODE, SYSTEM=S\n1\n2, 2.\n3, 2., 90.\n4, 3., 60., 30.\n" + element).mesh;
  EXPECT_EQ(sphere.nodes[2], Vec3(0, 2, 0));
  EXPECT_LT((sphere.nodes[3] - Vec3(3 * std::sqrt(3.) / 4, 9. / 4, 3. / 2)).norm(), 1e-15);
}

TEST(AbaqusDeck, OtherFilesAreReadInTheirPlace) {
  const TemporaryFolder folder;
  folder.write("nodes.txt", kNodes);
  folder.write("elements.txt", kElements);
  folder.write("fix.txt", "1, 2, 3, 4\n");
  folder.write("stiff.txt", "2\n");
  folder.write("more.inc", "*INCLUDE, INPUT=sets.inc\n");
  folder.write("sets.inc", "*NSET, NSET=FIX, INPUT=fix.txt\n*ELSET, ELSET=STIFF, INPUT=stiff.txt\n");
  folder.write("a.inp",
               "*NODE, INPUT=nodes.txt\n*ELEMENT, TYPE=C3D8, ELSET=ALL, INPUT=elements.txt\n"
               "*INCLUDE, INPUT=more.inc\n*NSET, NSET=LAST\n12\n");
  folder.write("b.inp", "*NODE\n*INCLUDE, INPUT=nodes.txt\n13, 5, 5, 5\n*ELEMENT, TYPE=C3D8\n" + kElements);
  const Mesh a = read_abaqus(folder.path("a.inp")).mesh;
  EXPECT_EQ(a.nodes, load(kDeck).mesh.nodes);
  EXPECT_EQ(a.node_sets.at("FIX"), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(a.node_sets.at("LAST"), (std::vector<int>{11}));
  EXPECT_EQ(a.region_names, (std::vector<std::string>{"ALL", "STIFF"}));
  EXPECT_EQ(read_abaqus(folder.path("b.inp")).mesh.cells, load(kDeck).mesh.cells);
}

TEST(AbaqusDeck, FilesThatAreNotThereOrHoldOtherThingsAreNamed) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    folder.write("deck.inp", text);
    return refusal_of([&] { read_abaqus(folder.path("deck.inp")); });
  };
  folder.write("keyword.txt", "1, 0, 0, 0\n*NSET, NSET=A\n");
  folder.write("bad.txt", "1, 0, 0, 0\n2, x\n");
  folder.write("circle.inc", "*INCLUDE, INPUT=circle.inc\n");
  EXPECT_CONTAINS(message(kDeck + "*NSET, NSET=A, INPUT=none.txt\n"), "deck.inp:17: *NSET, INPUT=\"none.txt\": ");
  EXPECT_CONTAINS(message("*NODE, INPUT=keyword.txt\n"), "keyword.txt:2: a keyword in a file named by INPUT=");
  EXPECT_CONTAINS(message("*NODE, INPUT=bad.txt\n"), "bad.txt:2: expected a coordinate (a finite number), found \"x\"");
  EXPECT_CONTAINS(message("*INCLUDE, INPUT=circle.inc\n"), "does a file include itself?");
  folder.write("nodes.txt", kNodes);
  EXPECT_CONTAINS(message("*NODE, INPUT=nodes.txt\n13, 1, 1, 1\n"), "deck.inp:2: data lines after a keyword with");
}

TEST(AbaqusDeck, ANodeSetMayBeTheNodesOfElements) {
  const Mesh mesh = load(kDeck + "*ELSET, ELSET=TOP\n2,\n*NSET, NSET=N, ELSET=TOP\n").mesh;
  EXPECT_EQ(mesh.node_sets.at("N"), (std::vector<int>{4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_CONTAINS(refusal(kDeck + "*NSET, NSET=N, ELSET=NONE\n"), "body.inp:17: no *ELSET \"NONE\"");
}

TEST(AbaqusDeck, EveryNodeThatASetListsMustExist) {
  EXPECT_CONTAINS(refusal(kDeck + "*NSET, NSET=N\n11, 12, 13\n"), "body.inp:18: *NSET: node 13 is not defined");
  const Warnings warnings = load(kDeck + "*ELSET, ELSET=E\n1, 2, 3\n").warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_CONTAINS(join(warnings), "element set \"E\" lists 1 element that no *ELEMENT defines");
}

// A set that contains itself is refused even if nothing uses it, whatever the order of the sets in the file.
TEST(AbaqusDeck, ASetThatContainsItselfIsRefusedByNameAndLine) {
  const auto circle = [](const std::string& sets) { return refusal(kDeck + "*SOLID SECTION, ELSET=ALL\n" + sets); };
  EXPECT_CONTAINS(circle("*ELSET, ELSET=_A\n1, _B\n*ELSET, ELSET=_B\n2, _A\n"),
                  "body.inp:21: *ELSET: set \"_A\" contains itself (_A contains _B contains _A)");
  EXPECT_CONTAINS(circle("*ELSET, ELSET=C\nD\n*ELSET, ELSET=D\nE\n*ELSET, ELSET=E\nD\n"),
                  "body.inp:23: *ELSET: set \"D\" contains itself (D contains E contains D)");
  EXPECT_CONTAINS(circle("*ELSET, ELSET=A\na\n"), "body.inp:19: *ELSET: set \"A\" contains itself (A contains A)");
  EXPECT_CONTAINS(circle("*NSET, NSET=M\n1, N\n*NSET, NSET=N\nM\n"),
                  "body.inp:21: *NSET: set \"M\" contains itself (M contains N contains M)");
}

// Thirty nested sets; a node set and an element set of the same name are two sets.
TEST(AbaqusDeck, SetsThatDoNotContainThemselvesMayNameEachOther) {
  std::string sets = "*NSET, NSET=S0\n1\n";
  for (int k = 1; k <= 30; ++k) sets += fmt::format("*NSET, NSET=S{}\nS{}, S{}\n", k, k - 1, 0);
  EXPECT_EQ(load(kDeck + sets).mesh.node_sets.at("S30"), std::vector<int>{0});
  EXPECT_EQ(load(kDeck + "*ELSET, ELSET=TOP\n2\n*NSET, NSET=TOP, ELSET=TOP\n").mesh.node_sets.at("TOP").size(), 8u);
  std::string chain = "*ELSET, ELSET=S0\n1\n";
  for (int k = 1; k <= 1100; ++k) chain += fmt::format("*ELSET, ELSET=S{}\nS{}\n", k, k - 1);
  EXPECT_CONTAINS(refusal(kDeck + chain), "nested more than 1000 deep");
}

TEST(AbaqusDeck, SetsMayNameElementsThatAreLeftOut) {
  const LoadedMesh loaded = load(kDeck +
                                 "*ELEMENT, TYPE=SPRINGA, ELSET=SPR\n3, 1, 9\n*ELEMENT, TYPE=MASS, ELSET=M\n4, 12\n"
                                 "*ELSET, ELSET=EVERYTHING\nALL, SPR, M, 4\n*SOLID SECTION, ELSET=ALL\n");
  EXPECT_EQ(loaded.mesh.region_names, std::vector<std::string>{"ALL"});
  EXPECT_CONTAINS(loaded.warnings[0], "neither solids nor surfaces are left out: MASS (1), SPRINGA (1)");
}

TEST(AbaqusDeck, SurplusNodesSayHowManyTheTypeHas) {
  EXPECT_CONTAINS(refusal(replaced(kDeck, "1,2,3,4,5,6,7,8\n", "1,2,3,4,5,6,7,8,9\n")),
                  "body.inp:15: element 1: 9 nodes, where a C3D8 has 8");
  EXPECT_CONTAINS(refusal(replaced(kDeck, "9,10,11,12\n", "9,10,11\n")),
                  "body.inp:16: element 2 ends early: 7 of the 8 nodes of a C3D8");
}

// Shells on the top: SPOS and SNEG are the same faces.
TEST(AbaqusDeck, SidesOfShellsAreSurfaces) {
  const std::string shells = kDeck + "*ELEMENT, TYPE=S4R, ELSET=SHELL\n3, 9, 10, 11, 12\n*SURFACE, NAME=A\nSHELL, ";
  const Mesh up = load(shells + "SPOS\n").mesh, down = load(shells + "SNEG\n").mesh;
  EXPECT_EQ(up.surfaces.at("A").size(), 1u);
  EXPECT_EQ(up.surfaces.at("A").size(), down.surfaces.at("A").size());
  EXPECT_CONTAINS(refusal(kDeck + "*SURFACE, NAME=A\nALL, SPOS\n"), "SPOS and SNEG are sides of shells");
}

const std::string kParts = "*PART, NAME=Cube\n*NODE\n" + kNodes + "*ELEMENT, TYPE=C3D8\n" + kElements +
                           "*ELSET, ELSET=Low\n1\n*ELSET, ELSET=High\n2\n*NSET, NSET=Foot\n1, 2, 3, 4\n"
                           "*ORIENTATION, NAME=O\n1, 0, 0, 0, 1, 0\n*SOLID SECTION, ELSET=Low, ORIENTATION=O\n"
                           "*SOLID SECTION, ELSET=High\n*END PART\n*ASSEMBLY, NAME=A\n";

// The second instance is translated by 5 along x, then rotated by 90 degrees about the z line through (5, 0): its edge
// along x becomes parallel to y.
TEST(AbaqusDeck, InstancesStandWhereTheyArePlaced) {
  const LoadedMesh loaded = load(kParts +
                                 "*INSTANCE, NAME=One, PART=Cube\n*END INSTANCE\n"
                                 "*INSTANCE, NAME=Two, PART=Cube\n5, 0, 0\n5, 0, 0, 5, 0, 1, 90\n*END INSTANCE\n"
                                 "*NODE\n1, 9, 9, 9\n*NSET, NSET=Feet, INSTANCE=One\nFoot\n"
                                 "*NSET, NSET=Feet, INSTANCE=Two\n1, 2\n*NSET, NSET=Tip\nTwo.11, One.Foot\n"
                                 "*NSET, NSET=Centre\n1\n*END ASSEMBLY\n");
  const Mesh& mesh = loaded.mesh;
  EXPECT_NEAR(volume(mesh), 4, 1e-14);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"One.Low", "One.High", "Two.Low", "Two.High"}));
  EXPECT_EQ(mesh.node_sets.at("Feet"), (std::vector<int>{0, 1, 2, 3, 12, 13}));
  EXPECT_EQ(mesh.node_sets.at("Two.Foot"), (std::vector<int>{12, 13, 14, 15}));
  EXPECT_EQ(mesh.node_sets.at("Tip"), (std::vector<int>{0, 1, 2, 3, 22}));
  EXPECT_LT((mesh.nodes[13] - Vec3(5, 1, 0)).norm(), 1e-15);
  EXPECT_LT((mesh.nodes[15] - Vec3(4, 0, 0)).norm(), 1e-15);
  // The section axes rotate with the instance.
  const CellData* first = find_cell_data(loaded, "axis_1");
  ASSERT_TRUE(first);
  const auto of_two = static_cast<std::ptrdiff_t>(3 * mesh.cells.size() / 2);
  EXPECT_LT((Eigen::Map<const Vec3>(&first->values[0]) - Vec3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((Eigen::Map<const Vec3>(&first->values[static_cast<std::size_t>(of_two)]) - Vec3(0, 1, 0)).norm(), 1e-15);
  EXPECT_CONTAINS(join(loaded.warnings), "1000 is added to those of Two");
}

// As written by Abaqus/CAE: part and assembly have sets of the same name with different nodes.
TEST(AbaqusDeck, SetsOfThePartAndOfTheAssemblyAreDifferentSets) {
  const Mesh mesh = load(kParts +
                         "*INSTANCE, NAME=Cube-1, PART=Cube\n*END INSTANCE\n"
                         "*NSET, NSET=Foot, INSTANCE=Cube-1\n9\n*END ASSEMBLY\n")
                        .mesh;
  EXPECT_EQ(mesh.node_sets.at("Foot"), std::vector<int>{8});
  EXPECT_EQ(mesh.node_sets.at("Cube-1.Foot"), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"Low", "High"}));
}

TEST(AbaqusDeck, InstancesThatCannotBePlacedAreRefused) {
  const auto message = [](const std::string& instance) { return refusal(kParts + "*INSTANCE, NAME=I, " + instance); };
  EXPECT_CONTAINS(message("PART=Ball\n"), "no *PART \"Ball\"");
  EXPECT_CONTAINS(message("LIBRARY=old\n"), "*INSTANCE, LIBRARY: results of an earlier analysis are not read");
  EXPECT_CONTAINS(message("PART=Cube\n0, 0, 0\n1, 1, 1, 1, 1, 1, 30\n"),
                  "two different points of the axis of rotation");
  EXPECT_CONTAINS(message("PART=Cube\n*END INSTANCE\n*NSET, NSET=N\n1\n"), "node 1 is not defined in the assembly");
  EXPECT_CONTAINS(message("PART=Cube\n*END INSTANCE\n*INSTANCE, NAME=I, PART=Cube\n"),
                  "*INSTANCE \"I\" is defined twice");
  EXPECT_CONTAINS(load(kParts + "*PART, NAME=Q\n*END PART\n*INSTANCE, NAME=I, PART=Cube\n").warnings.back() +
                      join(load(kParts + "*PART, NAME=Q\n*END PART\n*INSTANCE, NAME=I, PART=Cube\n").warnings),
                  "*PART \"Q\", which no *INSTANCE places");
}

// Columns: axes 1, 2 and 3 of the first tet of one of the two elements.
Mat3 axes_of(const LoadedMesh& loaded, std::size_t element) {
  const CellData *first = find_cell_data(loaded, "axis_1"), *second = find_cell_data(loaded, "axis_2");
  const std::size_t at = 3 * element * loaded.mesh.cells.size() / 2;
  Mat3 Q;
  Q.col(0) = Eigen::Map<const Vec3>(&first->values[at]);
  Q.col(1) = Eigen::Map<const Vec3>(&second->values[at]);
  Q.col(2) = Q.col(0).cross(Q.col(1));
  return Q;
}

const std::string kSection = "*SOLID SECTION, ELSET=ALL, ORIENTATION=WOOD\n";

Mat3 turn(double degrees, int axis) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::Unit(axis)).toRotationMatrix();
}

TEST(AbaqusDeck, DistributionsGiveEachElementItsAxes) {
  const std::string rows = ", 1, 0, 0, 0, 1, 0\n2, 0.8660254037844386, 0.5, 0, -0.5, 0.8660254037844386, 0\n";
  const std::string table =
      "*DISTRIBUTION TABLE, NAME=T\nCOORD3D, COORD3D\n*DISTRIBUTION, LOCATION=ELEMENT, TABLE=T, NAME=G\n";
  for (const std::string& start : {table, std::string("*DISTRIBUTION, NAME=G\n")}) {
    const LoadedMesh loaded = load(kDeck + start + rows + "*ORIENTATION, NAME=WOOD\nG\n1, 0\n" + kSection);
    EXPECT_LT((axes_of(loaded, 0) - Mat3::Identity()).norm(), 1e-15);
    EXPECT_LT((axes_of(loaded, 1) - turn(30, 2)).norm(), 1e-15);
  }
  // By a set, with an additional rotation by a distribution of angles.
  const LoadedMesh turned =
      load(kDeck + "*ELSET, ELSET=TOP\n2\n" + table + replaced(rows, "2, 0.8", "TOP, 0.8") +
           "*DISTRIBUTION TABLE, NAME=U\nANGLE\n*DISTRIBUTION, LOCATION=ELEMENT, TABLE=U, NAME=H\n"
           ", 0\n2, 15\n*ORIENTATION, NAME=WOOD\nG\n3, H\n" +
           kSection);
  EXPECT_LT((axes_of(turned, 0) - Mat3::Identity()).norm(), 1e-15);
  EXPECT_LT((axes_of(turned, 1) - turn(45, 2)).norm(), 1e-15);
}

TEST(AbaqusDeck, DistributionsThatDoNotSayTheAxesAreRefused) {
  const std::string use = "*ORIENTATION, NAME=WOOD\nG\n" + kSection;
  EXPECT_CONTAINS(refusal(kDeck + use), "no *DISTRIBUTION \"G\"");
  EXPECT_CONTAINS(refusal(kDeck + "*DISTRIBUTION, NAME=G\n2, 1, 0, 0, 0, 1, 0\n" + use),
                  "element 1: its distribution has neither a row for this element nor a default row");
  EXPECT_CONTAINS(
      refusal(kDeck + "*DISTRIBUTION, NAME=G, LOCATION=NODE\n2, 1, 0, 0, 0, 1, 0\n" + use),
      "distribution \"G\" does not give two points (COORD3D, COORD3D) by element, which orientation \"WOOD\" needs");
  EXPECT_CONTAINS(refusal(kDeck + "*DISTRIBUTION, NAME=G\n2, 1, 0, 0, 0, 1, 0, 7\n" + use), "7 values; a row of");
}

// The bricks' centres are (1/2, 1/2, 1/2 and 3/2).
TEST(AbaqusDeck, OrientationsMayBeCylindricalSphericalOrByAxis3) {
  const LoadedMesh cylindrical =
      load(kDeck + "*ORIENTATION, NAME=WOOD, SYSTEM=CYLINDRICAL\n0, 0, 0, 0, 0, 1\n" + kSection);
  EXPECT_LT((axes_of(cylindrical, 1) - turn(45, 2)).norm(), 1e-15);
  // At the first brick the radial direction is horizontal and the meridional direction is parallel to the polar axis y.
  const LoadedMesh spherical =
      load(kDeck + "*ORIENTATION, NAME=WOOD, SYSTEM=SPHERICAL\n0, 0.5, 0.5, 0, 1.5, 0.5\n" + kSection);
  Mat3 expected;
  expected << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  EXPECT_LT((axes_of(spherical, 0) - expected).norm(), 1e-15);
  const LoadedMesh by_third =
      load(kDeck + "*ORIENTATION, NAME=WOOD, SYSTEM=Z RECTANGULAR\n1, 0, 0, 1, 1, 0\n" + kSection);
  expected << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  EXPECT_LT((axes_of(by_third, 0) - expected).norm(), 1e-15);
  // Nodes 2 and 4 lie on x and y.
  EXPECT_LT(
      (axes_of(load(kDeck + "*ORIENTATION, NAME=WOOD, DEFINITION=NODES\n2, 4\n" + kSection), 0) - Mat3::Identity())
          .norm(),
      1e-15);
  EXPECT_CONTAINS(refusal(kDeck + "*ORIENTATION, NAME=WOOD, SYSTEM=CYLINDRICAL\n0.5, 0.5, 0, 0.5, 0.5, 1\n" + kSection),
                  "element 1: its centre is on the polar axis");
}

}  // namespace
}  // namespace orthodyn::abaqus_deck_test
