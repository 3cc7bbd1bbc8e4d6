#include "lib/mesh/io/vtu_text.h"

#include <gtest/gtest.h>

#include "lib/mesh/io/vtu.h"
#include "tests/mesh/refusal.h"
#include "tests/mesh/tets.h"

namespace orthodyn::vtu_text_test {
namespace {

const std::vector<Vec3> kPoints{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.0 / 3}};

VtuGrid two_tets() {
  VtuGrid grid{.points = kPoints, .cells = Cells(std::vector<std::array<int, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}})};
  grid.point_data = {{.name = "nodes:tip", .type = VtuNumber::uint8, .values = {0, 0, 0, 0, 1}}};
  grid.cell_data = {{.name = "region", .type = VtuNumber::int32, .values = {1, 0}},
                    {.name = "axis", .components = 3, .values = {0.1, 0, 0, 0, 1.0 / 3, 0}},
                    {.name = "rounded", .type = VtuNumber::float32, .values = {0.1, 2}}};
  grid.region_names = {"soft <wood>", "\"hard\""};
  return grid;
}

std::string whole(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += part;
  return text;
}

// The storage of VTK's vtkStringArray, which ParaView shows as names.
TEST(VtuText, HoldsNamesOfRegionsAsStrings) {
  for (const auto storage : {VtuStorage::ascii, VtuStorage::raw})
    EXPECT_CONTAINS(whole(vtu_text(two_tets(), storage)),
                    "<FieldData>\n<Array type=\"String\" Name=\"region_names\" NumberOfTuples=\"2\" format=\"ascii\">\n"
                    "115 111 102 116 32 60 119 111 111 100 62 0\n34 104 97 114 100 34 0\n</Array>\n</FieldData>");
}

class AnyStorage : public testing::TestWithParam<VtuStorage> {};

TEST_P(AnyStorage, KeepsTheGridAndItsFields) {
  const LoadedMesh read = read_vtu_text("grid.vtu", whole(vtu_text(two_tets(), GetParam())));
  EXPECT_EQ(read.mesh.nodes, kPoints);
  EXPECT_EQ(tets_of(read.mesh), (std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(read.mesh.region_names.at(static_cast<std::size_t>(read.mesh.region_of.at(0))), "\"hard\"");
  EXPECT_EQ(read.mesh.region_names.at(static_cast<std::size_t>(read.mesh.region_of.at(1))), "soft <wood>");
  EXPECT_EQ(read.mesh.node_sets.at("tip"), std::vector<int>{4});
  ASSERT_TRUE(find_cell_data(read, "axis") && find_cell_data(read, "rounded"));
  EXPECT_EQ(find_cell_data(read, "axis")->values, (std::vector<double>{0.1, 0, 0, 0, 1.0 / 3, 0}));
  EXPECT_EQ(find_cell_data(read, "rounded")->values.at(1), 2);
  const bool exact = GetParam() == VtuStorage::ascii;  // where no number is rounded to the type of its array
  EXPECT_EQ(find_cell_data(read, "rounded")->values.at(0), exact ? 0.1 : 0.1f);
}

// Only the reader of meshes asks for certain ones.
TEST_P(AnyStorage, WritesCellsOfAnyShape) {
  VtuGrid grid{.points = kPoints, .cells = {}};
  grid.cells.add(CellShape::tri3, std::array{0, 1, 2});
  grid.cells.add(CellShape::quad4, std::array{1, 4, 2, 0});
  const auto read = [&] { return read_vtu_text("grid.vtu", whole(vtu_text(grid, GetParam()))); };
  EXPECT_CONTAINS(refusal_of([&] { read(); }), "no solid cells");
  grid.cells.add(CellShape::tet4, std::array{1, 2, 3, 4});
  grid.cells.add(CellShape::tri3, std::array{1, 2, 3});
  grid.cells.add(CellShape::tet4, std::array{0, 1, 2, 3});
  const LoadedMesh loaded = read();
  EXPECT_EQ(tets_of(loaded.mesh), (std::vector<Tet>{{1, 2, 3, 4}, {0, 1, 2, 3}}));
  EXPECT_CONTAINS(loaded.warnings.at(0), "3 vertices, lines, triangles and quadrilaterals are ignored");
}

INSTANTIATE_TEST_SUITE_P(Storages, AnyStorage, testing::Values(VtuStorage::ascii, VtuStorage::raw),
                         [](const auto& test) { return test.param == VtuStorage::ascii ? "ascii" : "raw"; });

}  // namespace
}  // namespace orthodyn::vtu_text_test
