// Quadratic meshes: conversion from linear ones, validation, writing and reading.
#include "lib/mesh/quadratic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "lib/config/registry.h"
#include "lib/mesh/box.h"
#include "lib/mesh/cylinder.h"
#include "lib/mesh/io/mesh_file.h"
#include "lib/mesh/io/tetgen.h"
#include "lib/mesh/mesh_source.h"
#include "tests/mesh/refusal.h"

namespace orthodyn::quadratic_test {
namespace {

Mesh quadratic_box() {
  Mesh mesh = make_box({.size = {1, 2, 3}, .cells = {2, 1, 1}});
  mesh.node_sets["left"] = {};
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.nodes[n][0] == 0) mesh.node_sets["left"].push_back(static_cast<int>(n));
  make_quadratic(mesh);
  return mesh;
}

std::string refusal(Mesh mesh) {
  return refusal_of([&] { validate(mesh, {"beam"}); });
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) sum += cell_volume(mesh, c);
  return sum;
}

TEST(Quadratic, OfALinearMeshHasANodeHalfWayOnEachEdge) {
  Mesh mesh = quadratic_box();
  EXPECT_EQ(mesh.order(), 2);
  const Mesh linear = make_box({.size = {1, 2, 3}, .cells = {2, 1, 1}});
  std::set<std::pair<int, int>> edges;
  for (std::size_t t = 0; t < mesh.cells.size(); ++t)
    for (std::size_t e = 0; e < 6; ++e) {
      const int a = mesh.cells[t][kTetEdges[e][0]], b = mesh.cells[t][kTetEdges[e][1]];
      edges.insert(std::minmax(a, b));
      const auto at = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
      EXPECT_EQ(at(mesh.cells[t][4 + e]), Vec3((at(a) + at(b)) / 2));
    }
  EXPECT_EQ(mesh.nodes.size(), linear.nodes.size() + edges.size());
  EXPECT_TRUE(validate(mesh, {"box"}).empty());
  EXPECT_NEAR(volume(mesh), 6, 1e-14);
}

TEST(Quadratic, SetsOfNodesGetTheMiddlesBetweenThem) {
  const Mesh mesh = quadratic_box();
  std::size_t left = 0;
  for (const Vec3& x : mesh.nodes) left += x[0] == 0;
  EXPECT_EQ(mesh.node_sets.at("left").size(), left);
}

TEST(Quadratic, FacesHaveTheNodesOnTheirEdges) {
  const Mesh mesh = quadratic_box();
  const Cells faces = face_cells(mesh, mesh.surfaces.at("x0"));
  for (const CellShape shape : faces.shapes()) ASSERT_EQ(shape, CellShape::tri6);
  const auto at = [&](std::size_t face, std::size_t a) { return mesh.nodes[static_cast<std::size_t>(faces[face][a])]; };
  for (std::size_t face = 0; face < faces.size(); ++face)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(at(face, 3 + k), Vec3((at(face, k) + at(face, (k + 1) % 3)) / 2));
}

TEST(Quadratic, MadeLinearAgainIsTheMeshOfBefore) {
  Mesh mesh = quadratic_box();
  make_linear(mesh);
  const Mesh linear = make_box({.size = {1, 2, 3}, .cells = {2, 1, 1}});
  EXPECT_EQ(mesh.order(), 1);
  EXPECT_EQ(mesh.nodes, linear.nodes);
  EXPECT_EQ(mesh.cells, linear.cells);
  EXPECT_EQ(mesh.surfaces, linear.surfaces);
  for (const int n : mesh.node_sets.at("left")) EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(n)][0], 0);
  EXPECT_EQ(mesh.node_sets.at("left").size(), 4u);
}

TEST(Quadratic, MadeLinearTellsTheNodeSetsThatItEmpties) {
  Mesh mesh = quadratic_box();
  mesh.node_sets["middle"] = {mesh.cells[0][4], mesh.cells[0][5]};
  mesh.node_sets["both"] = {mesh.cells[0][4], mesh.cells[0][0]};
  mesh.node_sets["empty before"] = {};
  EXPECT_EQ(make_linear(mesh), std::vector<std::string>{"middle"});
  EXPECT_TRUE(mesh.node_sets.at("middle").empty());
  EXPECT_EQ(mesh.node_sets.at("both").size(), 1u);
}

TEST(QuadraticFiles, WarnOfNodeSetsThatAreEmptyWithOrderOne) {
  const TemporaryFolder folder;
  Mesh mesh = quadratic_box();
  mesh.node_sets["middle"] = {mesh.cells[0][4]};
  write_mesh({.mesh = mesh}, folder.path("box.inp"), false);
  const auto warnings = [&](const std::string& more) {
    const Config config = Config::from_text("{type: file, file: " + folder.path("box.inp") + more + "}");
    return Registry<MeshSource>::read(config)->load().warnings;
  };
  EXPECT_TRUE(warnings("").empty());
  ASSERT_EQ(warnings(", order: 1").size(), 1u);
  EXPECT_NE(warnings(", order: 1")[0].find("node set \"middle\" has mid-edge nodes only"), std::string::npos);
}

// A curved mesh with mid-edge nodes far from the midpoints.
TEST(QuadraticFiles, OfTetgenKeepACurvedMesh) {
  const TemporaryFolder folder;
  const Mesh tube =
      make_tube({{.radius = 1, .length = 0.5, .cells = {.around = 8, .through = 1, .along = 1}, .order = 2}, 0.9});
  write_mesh({.mesh = tube}, folder.path("tube.node"), false);
  EXPECT_EQ(read_mesh(folder.path("tube.node")).mesh.cells, tube.cells);
}

TEST(Quadratic, TwoNodesOnOneEdgeAreRefused) {
  Mesh mesh = quadratic_box();
  mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(mesh.cells[0][4])] + Vec3(0, 0, 1e-3));
  mesh.cells.nodes_of(0)[4] = static_cast<int>(mesh.nodes.size()) - 1;
  EXPECT_CONTAINS(refusal(mesh), "must share all nodes of a common edge");
}

TEST(Quadratic, ACornerOnAnEdgeIsRefused) {
  Mesh mesh = quadratic_box();
  mesh.cells.nodes_of(0)[4] = mesh.cells[0][2];
  EXPECT_CONTAINS(refusal(mesh), "must share all nodes of a common edge");
}

TEST(Quadratic, AnElementThatItsEdgesFoldOverIsRefusedByName) {
  Mesh mesh = quadratic_box();
  const auto tet = mesh.cells[3];
  auto& middle = mesh.nodes[static_cast<std::size_t>(tet[4])];
  const auto at = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
  middle = 0.1 * at(tet[0]) + 0.9 * at(tet[1]);  // beyond a quarter the map turns over at the corner
  EXPECT_CONTAINS(refusal(mesh), "its curved edges fold it over");
}

TEST(Quadratic, MixedOrdersAreRefused) {
  Mesh mesh = quadratic_box();
  const std::size_t last = mesh.cells.size() - 1;
  Cells mixed;
  for (std::size_t c = 0; c < last; ++c) mixed.add(CellShape::tet10, mesh.cells[c]);
  mixed.add(CellShape::tet4, mesh.cells.corners(last));
  mesh.cells = mixed;
  EXPECT_CONTAINS(refusal(mesh), "all must be of one order");
}

class QuadraticFiles : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formats, QuadraticFiles, testing::Values(".msh", ".msh2", ".inp", ".vtu", ".node"));

TEST_P(QuadraticFiles, KeepNodesElementsAndFaces) {
  const TemporaryFolder folder;
  Mesh mesh = quadratic_box();
  const std::string path = folder.path(std::string("mesh") + GetParam());
  write_mesh({.mesh = mesh}, path, false);
  const Mesh read = read_mesh(path).mesh;
  EXPECT_EQ(read.nodes, mesh.nodes);
  EXPECT_EQ(read.cells, mesh.cells);
  if (!read.surfaces.empty()) {
    EXPECT_EQ(read.surfaces.size(), mesh.surfaces.size());
  }
}

std::string data(const std::string& name) { return ORTHODYN_SOURCE_DIR "/tests/mesh/data/" + name; }

// An octant of the unit ball, meshed by Gmsh 4.8 (octant.geo). A wrong node order would fold elements or change the
// volume, which is 0.49 with straight edges.
class Octant : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Gmsh, Octant,
                         testing::Values("octant_22.msh", "octant_41.msh", "octant_gmsh.inp", "octant_gmsh.vtk"));

TEST_P(Octant, IsRound) {
  const Mesh mesh = read_mesh(data(GetParam())).mesh;
  EXPECT_EQ(mesh.order(), 2);
  EXPECT_EQ(mesh.nodes.size(), 150u);
  EXPECT_NEAR(volume(mesh), std::numbers::pi / 6, 1e-3);
  if (std::string(GetParam()).ends_with("vtk")) return;  // which holds no names
  const Cells faces = face_cells(mesh, mesh.surfaces.at("round"));
  for (const int n : faces.nodes()) EXPECT_NEAR(mesh.nodes[static_cast<std::size_t>(n)].norm(), 1, 1e-9);
}

// A quarter of a tube, from 1 to 2 m and 1 m long, of three hexahedra or six wedges with 20 or 15 nodes (tube.geo).
// A wrong order of mid-edge nodes would fold elements; with straight edges the volume is 4.5 % too small.
class Tube : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Gmsh, Tube,
                         testing::Values("tube_hexahedra_22.msh", "tube_hexahedra_41.msh", "tube_hexahedra_gmsh.inp",
                                         "tube_hexahedra_gmsh.vtk", "tube_wedges_41.msh", "tube_wedges_gmsh.inp",
                                         "tube_wedges_gmsh.vtk"));

TEST_P(Tube, IsRoundIfItsElementsAreSplit) {
  const LoadedMesh loaded = read_mesh(data(GetParam()), FileCells::split);
  const Mesh& mesh = loaded.mesh;
  EXPECT_EQ(mesh.order(), 2);
  EXPECT_NEAR(volume(mesh), std::numbers::pi * 3 / 4, 1e-3);
  const auto says = [](const std::string& warning) {
    return warning.find("quadratic tetrahedra") != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(loaded.warnings.begin(), loaded.warnings.end(), says));
  const Cells faces = face_cells(mesh, boundary_faces(mesh));
  for (const int n : faces.nodes()) {  // on edges of 30 degrees; by chords a middle would be 3.4 % too far inside
    const Vec3& x = mesh.nodes[static_cast<std::size_t>(n)];
    const double radius = std::hypot(x[0], x[1]);
    const bool is_straight = std::abs(x[0]) < 1e-9 || std::abs(x[1]) < 1e-9 || (x[2] < 1e-9 || x[2] > 1 - 1e-9);
    if (!is_straight) {
      EXPECT_LT(std::min(std::abs(radius - 1), std::abs(radius - 2)), 1e-3) << x.transpose();
    }
  }
}

TEST(QuadraticFiles, OfTetgenAreRead) {
  const Mesh mesh = read_mesh(data("cube_o2.ele")).mesh;
  EXPECT_EQ(mesh.order(), 2);
  EXPECT_NEAR(volume(mesh), 1, 1e-14);
  EXPECT_EQ(mesh.surfaces.size(), 6u);
}

TEST(QuadraticFiles, OfVegaAreNot) {
  const TemporaryFolder folder;
  EXPECT_CONTAINS(refusal_of([&] { write_mesh({.mesh = quadratic_box()}, folder.path("mesh.veg"), false); }),
                  "linear tetrahedra only");
}

// Versions of TetGen list mid-edge nodes in different orders.
TEST(QuadraticFiles, OfTetgenMayListTheNodesOnEdgesInAnyOrder) {
  const std::string node =
      "10 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 .5 0\n6 .5 0 0\n7 0 .5 0\n8 0 0 .5\n9 0 .5 .5\n10 .5 0 .5\n";
  const Mesh mesh = read_tetgen_text("t", {node, "1 10 0\n1 1 2 3 4 5 6 7 8 9 10\n", ""}).mesh;
  const auto nodes = mesh.cells[0];
  EXPECT_EQ(std::vector<int>(nodes.begin(), nodes.end()), (std::vector<int>{0, 1, 2, 3, 5, 4, 6, 7, 9, 8}));
}

// A polygon of 16 corners has 97.4 % of the area of its circle.
TEST(Quadratic, RoundBodiesHaveTheirTrueSurfaceAtOrderTwo) {
  Mesh cylinder = make_cylinder({.radius = 1, .length = 2, .cells = {.around = 16, .along = 2}, .order = 2});
  Mesh tube =
      make_tube({{.radius = 1, .length = 2, .cells = {.around = 12, .through = 1, .along = 2}, .order = 2}, 0.9});
  EXPECT_TRUE(validate(cylinder, {"cylinder"}).empty());
  EXPECT_TRUE(validate(tube, {"tube"}).empty());
  EXPECT_NEAR(volume(cylinder), 2 * std::numbers::pi, 1e-3);
  EXPECT_NEAR(volume(tube), 2 * std::numbers::pi * 0.19, 1e-3);
  const auto lies_on = [](const Mesh& mesh, const std::string& surface, double radius) {
    const Cells faces = face_cells(mesh, mesh.surfaces.at(surface));
    for (const int n : faces.nodes())
      EXPECT_NEAR(mesh.nodes[static_cast<std::size_t>(n)].head<2>().norm(), radius, 1e-14);
  };
  lies_on(cylinder, "outer", 1);
  lies_on(tube, "outer", 1);
  lies_on(tube, "inner", 0.9);
  // The coarsest mesh, with a core of one cell: no element is folded.
  const Mesh four =
      make_cylinder({.radius = 1, .length = 2, .cells = {.around = 4, .through = 1, .along = 1}, .order = 2});
  const Mesh three =
      make_tube({{.radius = 1, .length = 2, .cells = {.around = 3, .through = 1, .along = 1}, .order = 2}, 0.3});
  lies_on(four, "outer", 1);
  EXPECT_NEAR(volume(four), 2 * std::numbers::pi, 0.2);
  EXPECT_NEAR(volume(three), 2 * std::numbers::pi * 0.91, 0.5);
}

}  // namespace
}  // namespace orthodyn::quadratic_test
