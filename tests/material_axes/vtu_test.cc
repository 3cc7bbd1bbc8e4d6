// Axes from VTU files: reading returns the written axes.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "lib/mesh/box.h"
#include "tests/material_axes/axes_of.h"
#include "tests/mesh/tets.h"

namespace orthodyn::vtu_test {
namespace {

class AxesFromVtu : public testing::Test {
 protected:
  // Writes an ASCII file of a mesh with one cell data array per entry.
  static std::string write(const Mesh& mesh, const std::vector<std::pair<std::string, std::vector<Vec3>>>& data,
                           int components = 3) {
    const auto numbers = [](const auto& values) {
      std::string text;
      for (const auto& v : values)
        for (const auto x : v) text += fmt::format("{} ", x);
      return text;
    };
    std::string arrays, offsets, types;
    for (const auto& [name, values] : data)
      arrays += fmt::format(
          "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">{}</DataArray>\n", name,
          components, numbers(values));
    for (std::size_t e = 0; e < mesh.cells.size(); ++e) offsets += fmt::format("{} ", 4 * (e + 1)), types += "10 ";
    const auto path = std::filesystem::path(testing::TempDir()) /
                      fmt::format("{}.vtu", testing::UnitTest::GetInstance()->current_test_info()->name());
    std::ofstream(path) << fmt::format(R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="{}" NumberOfCells="{}"><CellData>{}</CellData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{}</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">{}</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">{}</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">{}</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>)",
                                       mesh.nodes.size(), mesh.cells.size(), arrays, numbers(mesh.nodes),
                                       numbers(tets_of(mesh)), offsets, types);
    return path.string();
  }

  AxesFromVtu() {
    Random random(61);
    for (std::size_t e = 0; e < mesh_.cells.size(); ++e) {
      rotations_.push_back(random.rotation());
      for (std::size_t i = 0; i < 3; ++i) axes_[i].push_back(rotations_.back().col(static_cast<Eigen::Index>(i)));
    }
  }

  static Mat3 at(const std::string& path, const Mesh& mesh, int element) {
    Warnings notes;
    const auto source = axes_source("{type: file, file: " + path + "}");
    return source->field(mesh, notes)(Vec3::Zero(), element);
  }
  std::string refused(const std::string& path) const {
    return refusal([&] { at(path, mesh_, 0); });
  }

  Mesh mesh_ = make_box({.cells = {2, 1, 1}});
  std::vector<Mat3> rotations_;
  std::array<std::vector<Vec3>, 3> axes_;
};

TEST_F(AxesFromVtu, AreItsCellData) {
  const auto path = write(mesh_, {{"axis_1", axes_[0]}, {"axis_2", axes_[1]}});
  for (std::size_t e = 0; e < mesh_.cells.size(); ++e)
    EXPECT_LE((at(path, mesh_, static_cast<int>(e)) - rotations_[e]).norm(), 1e-14);
}

TEST_F(AxesFromVtu, MayBeOneArrayOfNine) {
  std::vector<Vec3> nine;
  for (std::size_t e = 0; e < mesh_.cells.size(); ++e)
    for (const auto& axis : axes_) nine.push_back(axis[e]);
  const auto path = write(mesh_, {{"axes", nine}}, 9);
  EXPECT_LE((at(path, mesh_, 5) - rotations_[5]).norm(), 1e-14);
}

TEST_F(AxesFromVtu, MayBeOfTheMeshInAnotherUnit) {
  Mesh in_mm = mesh_;
  for (Vec3& x : in_mm.nodes) x *= 1000;
  EXPECT_LE((at(write(in_mm, {{"axis_1", axes_[0]}, {"axis_2", axes_[1]}}), mesh_, 3) - rotations_[3]).norm(), 1e-14);
}

TEST_F(AxesFromVtu, OfAnotherMeshOrOrderAreRefused) {
  Mesh other = mesh_;
  auto tets = tets_of(mesh_);
  std::swap(tets[1], tets[2]);
  other.cells = Cells(tets);
  EXPECT_TRUE(holds(refused(write(other, {{"axis_1", axes_[0]}, {"axis_2", axes_[1]}})), "cell 1 and element 1"));
  EXPECT_TRUE(holds(refused(write(mesh_, {{"axis_1", axes_[0]}})), "found axis_1 (3)"));
}

TEST_F(AxesFromVtu, ThatAreNoRotationAreRefusedWithTheCell) {
  axes_[1][4] = axes_[0][4];
  EXPECT_TRUE(
      holds(refused(write(mesh_, {{"axis_1", axes_[0]}, {"axis_2", axes_[1]}})), ".vtu: cell 4: the three directions"));
  axes_[2][0] *= -1;
  EXPECT_TRUE(holds(refused(write(mesh_, {{"axis_1", axes_[0]}, {"axis_2", axes_[1]}, {"axis_3", axes_[2]}})),
                    "cell 0: axis 3 points against"));
}

TEST_F(AxesFromVtu, WithoutAxesAreRefusedWithWhatThereIs) {
  EXPECT_TRUE(holds(refused(write(mesh_, {})),
                    "expected cell data axis_1, axis_2 (3 components each) or axes (9), found none"));
}

}  // namespace
}  // namespace orthodyn::vtu_test
