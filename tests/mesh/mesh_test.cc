#include "lib/mesh/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/mesh/box.h"
#include "tests/mesh/refusal.h"

namespace orthodyn::mesh_test {
namespace {

// The corner tet of the unit cube, volume 1/6.
Mesh one_tet(double scale = 1) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {scale, 0, 0}, {0, scale, 0}, {0, 0, scale}};
  mesh.cells = Cells(std::vector<Tet>{{0, 1, 2, 3}});
  mesh.region_of = {0};
  mesh.region_names = {"body"};
  return mesh;
}

// With a second tet at the inclined face.
Mesh two_tets() {
  Mesh mesh = one_tet();
  mesh.nodes.push_back({1, 1, 1});
  mesh.cells.add(CellShape::tet4, Tet{1, 2, 3, 4});
  mesh.region_of.push_back(0);
  return mesh;
}

// A tet with this dihedral angle at the edge 0-1.
Mesh sliver(double angle, double scale) {
  Mesh mesh = one_tet();
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, std::cos(angle), std::sin(angle)}};
  for (Vec3& x : mesh.nodes) x *= scale;
  return mesh;
}

// Inverts all elements.
void turn_over(Mesh& mesh) {
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) std::swap(mesh.cells.nodes_of(e)[0], mesh.cells.nodes_of(e)[1]);
}

std::string refusal(Mesh mesh, const MeshOrigin& origin = {"beam"}) {
  return refusal_of([&] { validate(mesh, origin); });
}

#define EXPECT_STARTS_WITH(text, start) EXPECT_EQ((text).substr(0, std::string(start).size()), start)

TEST(Mesh, TheBoundingBoxHoldsExactlyAllNodes) {
  Mesh mesh = one_tet();
  mesh.nodes.push_back({-1, 5, 0.5});
  const Box box = bounding_box(mesh);
  EXPECT_EQ(box.min, Vec3(-1, 0, 0));
  EXPECT_EQ(box.max, Vec3(1, 5, 1));
  EXPECT_DOUBLE_EQ(box.diagonal(), std::sqrt(4 + 25 + 1));
}

TEST(Mesh, NoNodesHaveNoBoundingBox) { EXPECT_THROW(bounding_box({}), ConfigError); }

TEST(Mesh, ACornerOfTheUnitCubeHasSixVolumesOfOne) { EXPECT_DOUBLE_EQ(signed_volume6(one_tet(), {0, 1, 2, 3}), 1); }

TEST(Mesh, SwappingTwoNodesChangesTheSignOfTheVolume) { EXPECT_DOUBLE_EQ(signed_volume6(one_tet(), {1, 0, 2, 3}), -1); }

TEST(Mesh, TheBoundaryOfOneTetIsItsFourFaces) { EXPECT_EQ(boundary_faces(one_tet()).size(), 4u); }

TEST(Mesh, TheFaceBetweenTwoTetsIsNotOnTheBoundary) {
  for (FaceCorners t : boundary_faces(two_tets())) {
    std::sort(t.begin(), t.end());
    EXPECT_NE(t, (FaceCorners{1, 2, 3}));
  }
  EXPECT_EQ(boundary_faces(two_tets()).size(), 6u);
}

// Gauss: the flux of x/3 through a closed surface that points outward is the volume inside.
TEST(Mesh, TheBoundaryPointsOutward) {
  const Mesh mesh = two_tets();
  double volume = 0;
  for (const FaceCorners& t : boundary_faces(mesh)) {
    const auto x = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(t[i])]; };
    volume += x(0).dot(x(1).cross(x(2))) / 6;
  }
  EXPECT_NEAR(volume, 1.0 / 6 + 1.0 / 3, 1e-15);
}

TEST(Validate, AcceptsAValidMeshUnchanged) {
  Mesh mesh = two_tets();
  EXPECT_TRUE(validate(mesh, {"beam"}).empty());
  EXPECT_EQ(mesh.cells, two_tets().cells);
  EXPECT_EQ(mesh.nodes, two_tets().nodes);
}

TEST(Validate, AcceptsSliversOfAHundredthOfADegreeAtAnyScale) {
  const double angle = 0.01 * std::numbers::pi / 180;
  for (double scale : {1e-7, 1.0, 1e7}) EXPECT_EQ(refusal(sliver(angle, scale)), "accepted");
}

TEST(Validate, RefusesFlatTetsAtAnyScale) {
  for (double scale : {1e-7, 1.0, 1e7}) {
    EXPECT_STARTS_WITH(refusal(sliver(1e-15, scale)), "beam: element 0: degenerate (volume ");
  }
}

TEST(Validate, RefusesATetThatUsesANodeTwice) {
  Mesh mesh = one_tet();
  mesh.cells = Cells(std::vector<Tet>{{0, 1, 2, 2}});
  EXPECT_STARTS_WITH(refusal(mesh), "beam: element 0: degenerate (volume 0 m^3");
}

TEST(Validate, RefusesATetOfOneSingleNode) {
  Mesh mesh = one_tet();
  mesh.cells = Cells(std::vector<Tet>{{1, 1, 1, 1}});
  EXPECT_STARTS_WITH(refusal(mesh), "beam: element 0: degenerate");
}

TEST(Validate, RefusesAnInvertedElementWithItsVolume) {
  Mesh mesh = one_tet(0.01);
  turn_over(mesh);
  EXPECT_EQ(refusal(mesh), "beam: element 0: inverted (volume -1.67e-07 m^3); reorder two of its nodes or remesh");
}

TEST(Validate, SaysHowManyElementsAreInverted) {
  Mesh mesh = two_tets();
  turn_over(mesh);
  EXPECT_CONTAINS(refusal(mesh), "2 of 2 elements are inverted");
}

TEST(Validate, NamesElementsAndNodesByTheirOrigin) {
  Mesh mesh = one_tet();
  MeshOrigin origin{.source = "beam.msh",
                    .cell_name = [](int t) { return "beam.msh:120: element " + std::to_string(17 + t); },
                    .node_name = [](int n) { return "beam.msh:7: node " + std::to_string(40 + n); }};
  turn_over(mesh);
  EXPECT_STARTS_WITH(refusal(mesh, origin), "beam.msh:120: element 17: inverted");
  mesh.nodes[2][1] = std::nan("");
  EXPECT_STARTS_WITH(refusal(mesh, origin), "beam.msh:7: node 42: coordinates (0, nan, 0)");
}

TEST(Validate, RefusesSizesWhoseVolumeCannotBeRepresented) {
  EXPECT_CONTAINS(refusal(one_tet(1e-120)), "cannot be represented");
  EXPECT_CONTAINS(refusal(one_tet(1e120)), "cannot be represented");
  EXPECT_EQ(refusal(one_tet(1e-60)), "accepted");
}

TEST(Validate, RefusesDifferencesOfCoordinatesThatOverflow) {
  Mesh mesh = one_tet();
  mesh.nodes[0] = {-1e308, -1e308, -1e308};
  mesh.nodes[1] = {1e308, 0, 0};
  EXPECT_STARTS_WITH(refusal(mesh), "beam: element 0: ");
}

TEST(Validate, RefusesTwoNodesAtTheSamePlaceAndNamesBoth) {
  Mesh mesh = two_tets();
  mesh.nodes.push_back(mesh.nodes[3]);
  mesh.cells.nodes_of(1)[2] = 5;
  const std::string message = refusal(mesh);
  EXPECT_STARTS_WITH(message, "beam: node 5: at exactly the same place (0, 0, 1) as beam: node 3;");
  EXPECT_CONTAINS(message, "Coherence Mesh");
}

TEST(Validate, TakesMinusZeroForTheSamePlaceAsZero) {
  Mesh mesh = two_tets();
  mesh.nodes.push_back({-0.0, 0.0, 1});
  mesh.cells.nodes_of(1)[2] = 5;
  EXPECT_CONTAINS(refusal(mesh), "exactly the same place");
}

TEST(Validate, AcceptsAnUnusedNodeAtThePlaceOfAnother) {
  Mesh mesh = one_tet();
  mesh.nodes.push_back(mesh.nodes[0]);
  EXPECT_EQ(refusal(mesh), "accepted");
}

TEST(Validate, RefusesAnElementListedTwice) {
  Mesh mesh = two_tets();
  mesh.cells.add(CellShape::tet4, Tet{1, 2, 0, 3});
  mesh.region_of.push_back(0);
  EXPECT_STARTS_WITH(refusal(mesh), "beam: element 2: the same nodes as beam: element 0");
}

TEST(Validate, RefusesElementsOnTheSameSideOfAFace) {
  Mesh mesh = two_tets();
  mesh.nodes[4] = {-1, -1, -1};
  mesh.cells = Cells(std::vector<Tet>{{0, 1, 2, 3}, {2, 1, 3, 4}});
  EXPECT_STARTS_WITH(refusal(mesh), "beam: element 1: overlaps beam: element 0");
}

TEST(Validate, RemovesNodesThatNoElementUsesWithAWarning) {
  Mesh mesh = one_tet();
  mesh.nodes.insert(mesh.nodes.begin() + 1, Vec3(7, 7, 7));
  mesh.cells = Cells(std::vector<Tet>{{0, 2, 3, 4}});
  mesh.surfaces["bottom"] = {{0, 3, 2}};
  const Warnings warnings = validate(mesh, {"beam"});
  EXPECT_EQ(warnings, Warnings{"beam: removed 1 node that no element uses (first: beam: node 1)"});
  EXPECT_EQ(mesh.nodes, one_tet().nodes);
  EXPECT_EQ(mesh.cells, one_tet().cells);
  EXPECT_EQ(mesh.surfaces.at("bottom"), (std::vector<FaceCorners>{{0, 2, 1}}));
}

TEST(Validate, TurnsBoundaryTrianglesOutward) {
  Mesh mesh = one_tet();
  mesh.surfaces["bottom"] = {{0, 1, 2}};
  validate(mesh, {"beam"});
  EXPECT_EQ(mesh.surfaces.at("bottom"), (std::vector<FaceCorners>{{0, 2, 1}}));
}

TEST(Validate, KeepsTheSideOfTrianglesBetweenTwoElements) {
  for (const FaceCorners& t : {FaceCorners{1, 2, 3}, FaceCorners{2, 1, 3}}) {
    Mesh mesh = two_tets();
    mesh.surfaces["inner"] = {t};
    validate(mesh, {"beam"});
    EXPECT_EQ(mesh.surfaces.at("inner"), std::vector<FaceCorners>{t});
  }
}

TEST(Validate, CountsATriangleListedTwiceOnceWithAWarning) {
  Mesh mesh = one_tet();
  mesh.surfaces["bottom"] = {{0, 1, 2}, {2, 1, 0}};
  EXPECT_EQ(validate(mesh, {"beam"}).size(), 1u);
  EXPECT_EQ(mesh.surfaces.at("bottom").size(), 1u);
}

TEST(Validate, RefusesATriangleOffTheMesh) {
  Mesh mesh = two_tets();
  mesh.surfaces["load"] = {{0, 1, 4}};
  EXPECT_STARTS_WITH(refusal(mesh), "beam: face 0: surface \"load\": not a face of any element");
}

TEST(Validate, RefusesAnEmptyMesh) { EXPECT_EQ(refusal({}), "beam: the mesh has no solid elements"); }

TEST(Validate, RefusesIndicesOutOfRange) {
  Mesh mesh = one_tet();
  mesh.cells.nodes_of(0)[3] = 4;
  EXPECT_EQ(refusal(mesh), "beam: element 0: uses node 4, but there are 4 nodes (0 to 3)");
  mesh.cells.nodes_of(0)[3] = -1;
  EXPECT_NE(refusal(mesh), "accepted");
}

TEST(Validate, RefusesATriangleWithAnIndexOutOfRange) {
  Mesh mesh = one_tet();
  mesh.surfaces["load"] = {{0, 1, 9}};
  EXPECT_STARTS_WITH(refusal(mesh), "beam: face 0: uses node 9");
}

TEST(Validate, RefusesRegionsOutOfRange) {
  Mesh mesh = one_tet();
  mesh.region_of = {1};
  EXPECT_STARTS_WITH(refusal(mesh), "beam: element 0: in region 1");
  mesh.region_of = {};
  EXPECT_STARTS_WITH(refusal(mesh), "beam: 1 elements but a region for 0");
}

TEST(Mesh, NodeSetsFollowTheNodesThatRemain) {
  Mesh mesh = two_tets();
  mesh.nodes.insert(mesh.nodes.begin() + 1, Vec3(9, 9, 9));
  mesh.cells = Cells(std::vector<Tet>{{0, 2, 3, 4}, {2, 3, 4, 5}});
  mesh.node_sets["ends"] = {5, 1, 0, 5};
  const Vec3 last = mesh.nodes[5];
  EXPECT_EQ(validate(mesh, {"beam"}).size(), 1u);
  EXPECT_EQ(mesh.node_sets.at("ends"), (std::vector<int>{0, 4}));
  EXPECT_EQ(mesh.nodes[4], last);
}

TEST(Mesh, ANodeSetMayOnlyNameNodesOfTheMesh) {
  Mesh mesh = one_tet();
  mesh.node_sets["ends"] = {0, 4};
  EXPECT_CONTAINS(refusal(mesh), "node set \"ends\": uses node 4, but there are 4 nodes");
}

}  // namespace
}  // namespace orthodyn::mesh_test
