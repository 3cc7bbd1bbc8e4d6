// Uniform refinement.
#include "lib/mesh/refine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/mesh/box.h"
#include "lib/mesh/cylinder.h"
#include "lib/mesh/quadratic.h"
#include "tests/element/states.h"

namespace orthodyn::refine_test {
namespace {

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) sum += cell_volume(mesh, e);
  return sum;
}

double area(const Mesh& mesh, const std::vector<FaceCorners>& triangles) {
  double sum = 0;
  for (const FaceCorners& t : triangles) {
    const auto x = [&](std::size_t k) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(t[k])]; };
    sum += (x(1) - x(0)).cross(x(2) - x(0)).norm() / 2;
  }
  return sum;
}

// A mesh with displaced inner nodes, two regions, a node set and cell data.
LoadedMesh distorted() {
  LoadedMesh loaded{.mesh = make_box({.size = {2, 1, 1}, .cells = {3, 2, 2}, .split = BoxMesh::Split::six})};
  Mesh& mesh = loaded.mesh;
  Random random(521);
  for (Vec3& x : mesh.nodes)
    if (x[0] > 0.1 && x[0] < 1.9) x[0] += 0.1 * random.between(-1, 1);
  mesh.region_names = {"a", "b"};
  CellData axis{.name = "number", .components = 2};
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    mesh.region_of[k] = k % 3 == 0;
    axis.values.push_back(static_cast<double>(k));
    axis.values.push_back(-static_cast<double>(k));
  }
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n)
    if (mesh.nodes[static_cast<std::size_t>(n)][2] == 0) mesh.node_sets["floor"].push_back(n);
  loaded.cell_data = {axis};
  return loaded;
}

class Refinement : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Order, Refinement, testing::Values(1, 2));

TEST_P(Refinement, IsAValidMeshOfEightTimesAsManyCells) {
  LoadedMesh loaded = distorted();
  if (GetParam() == 2) make_quadratic(loaded.mesh);
  const LoadedMesh before = loaded;
  refine(loaded);
  Mesh& mesh = loaded.mesh;
  EXPECT_EQ(mesh.order(), GetParam());
  ASSERT_EQ(mesh.cells.size(), 8 * before.mesh.cells.size());
  EXPECT_TRUE(validate(mesh, {.source = "refined"}).empty());  // conforming, positive, no node too many
  EXPECT_NEAR(volume(mesh), volume(before.mesh), 1e-13);
  for (std::size_t k = 0; k < before.mesh.cells.size(); ++k) {
    double sum = 0;
    for (std::size_t i = 8 * k; i < 8 * k + 8; ++i) {
      EXPECT_EQ(mesh.region_of[i], before.mesh.region_of[k]);
      EXPECT_EQ(mesh.cell_of[i], static_cast<int>(k));  // whose axes it has, where a file gives them
      EXPECT_EQ(loaded.cell_data[0].values[2 * i], static_cast<double>(k));
      EXPECT_EQ(loaded.cell_data[0].values[2 * i + 1], -static_cast<double>(k));
      sum += 6 * cell_volume(mesh, i);
      EXPECT_NEAR(6 * cell_volume(mesh, i), 6 * cell_volume(before.mesh, k) / 8, 1e-13);
    }
    EXPECT_NEAR(sum, 6 * cell_volume(before.mesh, k), 1e-13);
  }
}

TEST_P(Refinement, KeepsSurfacesAndNodeSets) {
  LoadedMesh loaded = distorted();
  if (GetParam() == 2) make_quadratic(loaded.mesh);
  const LoadedMesh before = loaded;
  refine(loaded);
  const Mesh& mesh = loaded.mesh;
  for (const auto& [name, triangles] : before.mesh.surfaces) {
    EXPECT_EQ(mesh.surfaces.at(name).size(), 4 * triangles.size()) << name;
    EXPECT_NEAR(area(mesh, mesh.surfaces.at(name)), area(before.mesh, triangles), 1e-13) << name;
  }
  std::vector<int> floor;
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n)
    if (mesh.nodes[static_cast<std::size_t>(n)][2] == 0) floor.push_back(n);
  EXPECT_EQ(mesh.node_sets.at("floor"), floor);
}

// Refinement keeps the volume of curved cells: a cylinder stays as round as before.
TEST(Refinement, KeepsCurvedEdges) {
  LoadedMesh loaded{.mesh = make_cylinder({.radius = 1, .length = 1, .cells = {8, 1, 1}, .order = 2})};
  refine(loaded);
  EXPECT_TRUE(validate(loaded.mesh, {.source = "refined"}).empty());
  // The parabola through three points of a circle, 1/16 of a turn apart, at the quarter points of an edge.
  const double half = std::numbers::pi / 8, sagitta = 1 - std::cos(half);
  const double x = std::sin(half) / 2, y = std::cos(half) + 0.75 * sagitta;
  int at_quarters = 0;
  for (const Vec3& at : loaded.mesh.nodes) {
    const double r = at.tail<2>().norm() > 0.9 ? at.tail<2>().norm() : at.head<2>().norm();
    if (std::abs(r - std::hypot(x, y)) < 1e-12) ++at_quarters;
  }
  EXPECT_GE(at_quarters, 2 * 8 * 2);
}

}  // namespace
}  // namespace orthodyn::refine_test
