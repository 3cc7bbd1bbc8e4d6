// Sizes and shared nodes of the parts of a mesh, compared with counts by hand.
#include "lib/mesh/partition.h"

#include <gtest/gtest.h>

#include "lib/mesh/box.h"

namespace orthodyn::partition_test {
namespace {

// A row of cubes of six tetrahedra each.
Mesh row_of_cubes(int cubes) {
  return make_box({.size = Vec3(cubes, 1, 1), .cells = {cubes, 1, 1}, .split = BoxMesh::Split::six});
}

int cube_of(const Mesh& mesh, std::size_t cell) { return static_cast<int>(centroid(mesh, static_cast<int>(cell)).x()); }

std::vector<int> one_part_a_cube(const Mesh& mesh) {
  std::vector<int> part;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) part.push_back(cube_of(mesh, cell));
  return part;
}

TEST(Partition, CellsThatShareAFaceAreNeighbours) {
  const Mesh mesh = row_of_cubes(2);
  const CellGraph graph = cell_graph(sorted_faces(mesh), mesh.cells.size());
  ASSERT_EQ(graph.start.size(), mesh.cells.size() + 1);
  int across = 0;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    for (int k = graph.start[cell]; k < graph.start[cell + 1]; ++k) {
      const auto neighbour = static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(k)]);
      int shared = 0;
      for (const int a : mesh.cells[cell])
        for (const int b : mesh.cells[neighbour]) shared += a == b ? 1 : 0;
      EXPECT_EQ(shared, 3);
      across += cube_of(mesh, cell) != cube_of(mesh, neighbour) ? 1 : 0;
    }
  EXPECT_EQ(across, 4);                            // two faces of tetrahedra, seen from both sides
  EXPECT_EQ(graph.start.back(), 2 * (2 * 6 + 2));  // six faces within each cube
}

TEST(Partition, FiguresOfARowOfCubesAreThoseOfItsFaces) {
  const Mesh mesh = row_of_cubes(3);
  const auto figures = part_sizes(mesh, one_part_a_cube(mesh), 3);
  ASSERT_EQ(figures.size(), 3u);
  long owned = 0, copies = 0, copied = 0;
  for (const PartSize& part : figures) {
    EXPECT_EQ(part.cells, 6);
    EXPECT_EQ(part.owned + part.copies, 8);  // a cube has eight corners
    owned += part.owned, copies += part.copies, copied += part.copied;
  }
  EXPECT_EQ(owned, 16);
  EXPECT_EQ(copies, 8);  // two faces of four nodes, each of two parts
  EXPECT_EQ(copied, 8);
  EXPECT_EQ(figures[0].neighbours, 1);
  EXPECT_EQ(figures[1].neighbours, 2);
  EXPECT_EQ(figures[2].neighbours, 1);
}

TEST(Partition, PartsWithoutCellsHaveNothing) {
  const Mesh mesh = row_of_cubes(1);
  const auto figures = part_sizes(mesh, std::vector<int>(mesh.cells.size(), 1), 3);
  for (const std::size_t empty : {0u, 2u}) {
    EXPECT_EQ(figures[empty].cells + figures[empty].owned + figures[empty].copies + figures[empty].copied, 0);
    EXPECT_EQ(figures[empty].neighbours, 0);
  }
  EXPECT_EQ(figures[1].owned, 8);
}

}  // namespace
}  // namespace orthodyn::partition_test
