// Axes of hexahedra: each tetrahedron gets the axes of the element that it was split from.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "lib/mesh/io/vtu.h"
#include "lib/mesh/refine.h"
#include "tests/material_axes/axes_of.h"
#include "tests/mesh/tets.h"

namespace orthodyn::split_mesh_test {
namespace {

// Two cubes with axes rotated about z by 0 and 90 degrees.
const std::string kVtu = R"(<VTKFile type="UnstructuredGrid" version="0.1">
<UnstructuredGrid>
<Piece NumberOfPoints="12" NumberOfCells="2">
<CellData>
<DataArray type="Float64" Name="axis_1" NumberOfComponents="3" format="ascii">1 0 0 0 1 0</DataArray>
<DataArray type="Float64" Name="axis_2" NumberOfComponents="3" format="ascii">0 1 0 -1 0 0</DataArray>
</CellData>
<Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 1 1 0 0 1 0
0 0 1 1 0 1 1 1 1 0 1 1
2 0 0 2 1 0 2 0 1 2 1 1
</DataArray>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7 1 8 9 2 5 10 11 6</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">8 16</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">12 12</DataArray>
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

const std::string kHead = "a1x,a1y,a1z,a2x,a2y,a2z\n", kFirst = "1,0,0,0,1,0\n", kSecond = "0,1,0,-1,0,0\n";

class AxesOfASplitMesh : public testing::Test {
 protected:
  static std::string write(const std::string& ending, const std::string& text) {
    const auto path = std::filesystem::path(testing::TempDir()) /
                      fmt::format("split_{}{}", testing::UnitTest::GetInstance()->current_test_info()->name(), ending);
    std::ofstream(path) << text;
    return path.string();
  }
  AxesField field(const std::string& path) {
    source_ = axes_source("{type: file, file: " + path + "}");
    return source_->field(mesh_, notes_);
  }
  void expect_those_of_cells(const AxesField& axes) const {
    for (std::size_t t = 0; t < mesh_.cells.size(); ++t)
      EXPECT_EQ(axes(Vec3::Zero(), static_cast<int>(t)).col(0), mesh_.cell_of[t] == 0 ? Vec3::UnitX() : Vec3::UnitY())
          << t;
  }

  Mesh mesh_ = read_vtu_text("cubes.vtu", kVtu, FileCells::split).mesh;
  std::shared_ptr<const AxesSource> source_;
  Warnings notes_;
};

TEST_F(AxesOfASplitMesh, HaveARowOfCsvForEachElementOfTheFile) {
  ASSERT_EQ(mesh_.cells.size(), 12u);
  expect_those_of_cells(field(write(".csv", kHead + kFirst + kSecond)));
}

TEST_F(AxesOfASplitMesh, MayNameTheElementsInCsv) {
  expect_those_of_cells(field(write(".csv", "element," + kHead + "1," + kSecond + "0," + kFirst)));
}

TEST_F(AxesOfASplitMesh, AreRefusedWhereRowsAreNotOfTheFilesElements) {
  EXPECT_TRUE(holds(refusal([&] { field(write(".csv", kHead + kFirst)); }),
                    "1 rows for a mesh of 2 elements (split into 12 cells)"));
  EXPECT_TRUE(holds(refusal([&] { field(write(".csv", "element," + kHead + "2," + kFirst)); }),
                    "element 2 does not exist; the mesh has 0 to 1"));
  const auto axes = field(write(".csv", "element," + kHead + "0," + kFirst));
  EXPECT_TRUE(holds(refusal([&] { axes(Vec3::Zero(), 11); }), "has no row for element 1"));
}

TEST_F(AxesOfASplitMesh, MayBeCellDataOfTheHexahedra) { expect_those_of_cells(field(write(".vtu", kVtu))); }

TEST_F(AxesOfASplitMesh, MayBeCellDataOfTheTetrahedra) {
  expect_those_of_cells(
      field(write(".vtu", write_vtu(read_vtu_text("cubes.vtu", kVtu, FileCells::split)).files.front().text)));
}

// Axes of the hexahedra, of their tetrahedra in another file, and in CSV rows; axis 1 of the second cube is along y.
TEST_F(AxesOfASplitMesh, StayWhereTheMeshIsRefined) {
  const std::string of_tets = write_vtu(read_vtu_text("cubes.vtu", kVtu, FileCells::split)).files.front().text;
  LoadedMesh loaded{.mesh = mesh_};
  for (int level = 0; level < 2; ++level) {
    refine(loaded);
    mesh_ = loaded.mesh;
    expect_those_of_cells(field(write(".vtu", kVtu)));
    expect_those_of_cells(field(write(".vtu", of_tets)));
    expect_those_of_cells(field(write(".csv", kHead + kFirst + kSecond)));
  }
}

TEST_F(AxesOfASplitMesh, OfAnotherMeshAreRefusedWhereItIsRefined) {
  LoadedMesh loaded{.mesh = mesh_};
  refine(loaded);
  auto tets = tets_of(loaded.mesh);
  std::swap(tets[0], tets[95]);
  std::rotate(tets.begin(), tets.begin() + 48, tets.end());
  mesh_ = loaded.mesh;
  mesh_.cells = Cells(tets);
  EXPECT_TRUE(holds(refusal([&] { field(write(".vtu", kVtu)); }), "have different positions"));
  tets.pop_back();
  mesh_.cells = Cells(tets);
  EXPECT_TRUE(holds(refusal([&] { field(write(".vtu", kVtu)); }), "12 cells for a mesh of 95"));
}

TEST_F(AxesOfASplitMesh, ThatAreNoRotationAreRefusedWithTheCell) {
  std::string flat = kVtu;
  flat.replace(flat.find("0 1 0 -1 0 0"), 12, "0 1 0 0 1 0 ");
  EXPECT_TRUE(holds(refusal([&] { field(write(".vtu", flat)); }), ".vtu: cell 1: the three directions"));
}

}  // namespace
}  // namespace orthodyn::split_mesh_test
