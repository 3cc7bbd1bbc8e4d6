// Hexahedra and wedges of files that stay as they are. Tests write and read them in all formats, reverse their
// orientation and split them; some files must be split or refused.
#include "lib/mesh/whole_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "lib/mesh/box.h"
#include "lib/mesh/io/mesh_file.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/quadratic.h"
#include "tests/mesh/refusal.h"

namespace orthodyn::whole_cells_test {
namespace {

LoadedMesh sample(BoxMesh::Elements elements, bool centres) {
  LoadedMesh loaded{.mesh = make_box({.size = Vec3(1, 2, 3) / 3, .cells = {2, 2, 1}, .elements = elements})};
  make_quadratic(loaded.mesh);
  if (centres) add_centres(loaded.mesh);
  std::erase_if(loaded.mesh.surfaces,
                [](const auto& surface) { return surface.first != "x0" && surface.first != "z1"; });
  validate(loaded.mesh, {"sample"});
  return loaded;
}

// Abaqus reads at most sixteen.
std::ptrdiff_t most_entries_on_a_line(const std::string& text) {
  std::ptrdiff_t most = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto commas = std::count(line.begin(), line.end(), ',');
    most = std::max(most, line.find_last_not_of(", ") < line.rfind(',') ? commas : commas + 1);
  }
  return most;
}

struct Sample {
  const char* name;
  BoxMesh::Elements elements;
  bool centres;
};

using FormatAndSample = std::tuple<std::string, Sample>;
class WholeCells : public testing::TestWithParam<FormatAndSample> {};
INSTANTIATE_TEST_SUITE_P(Formats, WholeCells,
                         testing::Combine(testing::Values(".msh", ".msh2", ".inp", ".vtu"),
                                          testing::Values(Sample{"hex20", BoxMesh::Elements::hexahedra, false},
                                                          Sample{"hex27", BoxMesh::Elements::hexahedra, true},
                                                          Sample{"wedge15", BoxMesh::Elements::wedges, false},
                                                          Sample{"wedge18", BoxMesh::Elements::wedges, true})),
                         [](const auto& one) {
                           return std::get<0>(one.param).substr(1) + "_" + std::get<1>(one.param).name;
                         });

TEST_P(WholeCells, AreTheSameAfterWritingAndReading) {
  const auto& [ending, kind] = GetParam();
  const LoadedMesh loaded = sample(kind.elements, kind.centres);
  const TemporaryFolder folder;
  write_mesh(loaded, folder.path("mesh" + ending), false);
  const LoadedMesh read = read_mesh(folder.path("mesh" + ending));
  EXPECT_EQ(read.mesh.nodes, loaded.mesh.nodes);
  EXPECT_EQ(read.mesh.cells, loaded.mesh.cells);
  if (ending == ".inp") {
    EXPECT_LE(most_entries_on_a_line(read_text_file(folder.path("mesh.inp"))), 16);
  }
  EXPECT_TRUE(read.mesh.cell_of.empty());
  if (ending != ".vtu") {
    EXPECT_EQ(read.mesh.surfaces, loaded.mesh.surfaces);
  }
}

// All tetrahedra together fill the box, with the nodes of the file.
TEST_P(WholeCells, BecomeTetrahedraOnRequest) {
  const auto& [ending, kind] = GetParam();
  const TemporaryFolder folder;
  write_mesh(sample(kind.elements, kind.centres), folder.path("mesh" + ending), false);
  const LoadedMesh read = read_mesh(folder.path("mesh" + ending), FileCells::split);
  EXPECT_TRUE(read.mesh.has_tets_only());
  EXPECT_EQ(read.mesh.order(), 2);
  EXPECT_FALSE(read.mesh.cell_of.empty());
  double volume = 0;
  for (std::size_t c = 0; c < read.mesh.cells.size(); ++c) volume += cell_volume(read.mesh, c);
  EXPECT_NEAR(volume, 6.0 / 27, 1e-14);
}

TEST(TurnedCells, HaveTheOppositeVolumeAndTurnBack) {
  for (const auto elements : {BoxMesh::Elements::hexahedra, BoxMesh::Elements::wedges, BoxMesh::Elements::tetrahedra})
    for (const bool centres : {false, true}) {
      Mesh mesh = sample(elements, centres).mesh;
      const Cells before = mesh.cells;
      const double volume = cell_volume(mesh, 0);
      turn_cell(mesh.cells.shape(0), mesh.cells.nodes_of(0));
      EXPECT_NEAR(cell_volume(mesh, 0), -volume, 1e-15);
      turn_cell(mesh.cells.shape(0), mesh.cells.nodes_of(0));
      EXPECT_EQ(mesh.cells, before);
    }
}

std::string two_cells(const std::string& second) {
  return R"(*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 2, 0.5, 0.5
*ELEMENT, TYPE=C3D8
1, 1, 2, 3, 4, 5, 6, 7, 8
)" + second;
}

TEST(LinearHexahedra, StayAsTheyAre) {
  const TemporaryFolder folder;
  folder.write("one.inp", two_cells(""));
  const std::string path = folder.path("one.inp");
  EXPECT_TRUE(read_mesh(path, FileCells::split).mesh.has_tets_only());
  Mesh mesh = read_mesh(path).mesh;
  ASSERT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.cells.shape(0), CellShape::hex8);
  make_quadratic(mesh);
  EXPECT_EQ(mesh.cells.shape(0), CellShape::hex20);
  EXPECT_NEAR(cell_volume(mesh, 0), 1, 1e-15);
}

TEST(ATriangleOnAQuadrilateral, IsRefused) {
  Mesh mesh = make_box({.elements = BoxMesh::Elements::hexahedra});
  mesh.nodes.emplace_back(2, 0.5, 0.5);
  mesh.cells.add(CellShape::tet4, std::array{1, 3, 7, 8});
  mesh.region_of.push_back(0);
  mesh.surfaces.clear();
  EXPECT_CONTAINS(refusal_of([&] { validate(mesh, {"box"}); }), "lies on a quadrilateral of box: element 0");
}

TEST(Pyramids, AreSplitWithAllOtherElements) {
  const TemporaryFolder folder;
  folder.write("two.inp", two_cells("*ELEMENT, TYPE=C3D5\n2, 2, 6, 7, 3, 9\n"));
  const std::string path = folder.path("two.inp");
  const Mesh mesh = read_mesh(path, FileCells::keep).mesh;
  EXPECT_TRUE(mesh.has_tets_only());
  EXPECT_GT(mesh.cells.size(), 6u);
}

// Its triangle matches half of the face of a hexahedron that is split.
TEST(ATetrahedronOnAQuadrilateral, SplitsAllElements) {
  const TemporaryFolder folder;
  folder.write("two.inp", two_cells("*ELEMENT, TYPE=C3D4\n2, 2, 3, 7, 9\n"));
  const std::string path = folder.path("two.inp");
  EXPECT_TRUE(read_mesh(path, FileCells::keep).mesh.has_tets_only());
}

}  // namespace
}  // namespace orthodyn::whole_cells_test
