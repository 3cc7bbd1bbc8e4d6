// The same mesh in every format: a cube of one hexahedron beside a cube of two wedges.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lib/core/spelling.h"
#include "lib/mesh/cell_volume.h"
#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/gmsh.h"
#include "lib/mesh/io/vega.h"
#include "lib/mesh/io/vtk.h"
#include "lib/mesh/io/vtu.h"
#include "lib/mesh/mesh_faces.h"
#include "tests/mesh/refusal.h"
#include "tests/mesh/tets.h"

namespace orthodyn::hexahedra_test {
namespace {

const std::string kGmsh22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
2 1 "clamped"
2 2 "top"
3 3 "left"
3 4 "right"
$EndPhysicalNames
$Nodes
12
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
9 2 0 0
10 2 1 0
11 2 0 1
12 2 1 1
$EndNodes
$Elements
7
1 3 2 1 1 1 5 8 4
2 3 2 2 2 5 6 7 8
3 2 2 2 3 6 11 12
4 2 2 2 3 6 12 7
5 5 2 3 1 1 2 3 4 5 6 7 8
6 6 2 4 2 2 9 10 6 11 12
7 6 2 4 2 2 10 3 6 12 7
$EndElements
)";

const std::string kGmsh41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
2 1 "clamped"
2 2 "top"
3 3 "left"
3 4 "right"
$EndPhysicalNames
$Entities
0 0 3 2
1 0 0 0 0 1 1 1 1 0
2 0 0 1 1 1 1 1 2 0
3 1 0 1 2 1 1 1 2 0
1 0 0 0 1 1 1 1 3 0
2 1 0 0 2 1 1 1 4 0
$EndEntities
$Nodes
1 12 1 12
3 1 0 12
1
2
3
4
5
6
7
8
9
10
11
12
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
2 0 0
2 1 0
2 0 1
2 1 1
$EndNodes
$Elements
5 7 1 7
2 1 3 1
1 1 5 8 4
2 2 3 1
2 5 6 7 8
2 3 2 2
3 6 11 12
4 6 12 7
3 1 5 1
5 1 2 3 4 5 6 7 8
3 2 6 2
6 2 9 10 6 11 12
7 2 10 3 6 12 7
$EndElements
)";

const std::string kAbaqus = R"(*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 2, 0, 0
10, 2, 1, 0
11, 2, 0, 1
12, 2, 1, 1
*ELEMENT, TYPE=C3D8R, ELSET=left
5, 1, 2, 3, 4, 5,
6, 7, 8
*ELEMENT, TYPE=C3D6, ELSET=right
6, 2, 9, 10, 6, 11, 12
7, 2, 10, 3, 6, 12, 7
*SURFACE, NAME=clamped
left, S6
*SURFACE, NAME=top
left, S2
right, S2
)";

const std::string kVtk = R"(# vtk DataFile Version 3.0
three cells
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 12 double
0 0 0 1 0 0 1 1 0 0 1 0
0 0 1 1 0 1 1 1 1 0 1 1
2 0 0 2 1 0 2 0 1 2 1 1
CELLS 4 28
4 0 4 7 3
8 0 1 2 3 4 5 6 7
6 5 10 11 1 8 9
6 5 11 6 1 9 2
CELL_TYPES 4
9 12 13 13
CELL_DATA 4
SCALARS region int
LOOKUP_TABLE default
5 3 4 4
SCALARS angle double 2
LOOKUP_TABLE default
9 9 10 11 20 21 30 31
)";

const std::string kVtu = R"(<VTKFile type="UnstructuredGrid" version="0.1">
<UnstructuredGrid>
<Piece NumberOfPoints="12" NumberOfCells="3">
<CellData>
<DataArray type="Int32" Name="region" format="ascii">3 4 4</DataArray>
<DataArray type="Float64" Name="angle" NumberOfComponents="2" format="ascii">10 11 20 21 30 31</DataArray>
</CellData>
<Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 1 1 0 0 1 0
0 0 1 1 0 1 1 1 1 0 1 1
2 0 0 2 1 0 2 0 1 2 1 1
</DataArray>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7 5 10 11 1 8 9 5 11 6 1 9 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">8 14 20</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">12 13 13</DataArray>
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

const std::string kVega = R"(*VERTICES
12 3
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
9 2 0 0
10 2 1 0
11 2 0 1
12 2 1 1
*ELEMENTS
CUBIC
2 8
1 1 2 3 4 5 6 7 8
2 2 9 10 3 6 11 12 7
)";

struct Format {
  const char* name;
  const std::string* text;
  LoadedMesh (*read)(const std::string& path, std::string_view text, FileCells cells);
  bool has_surfaces;
};

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) sum += cell_volume(mesh, e);
  return sum;
}

std::set<std::set<int>> sets_of(const Mesh& mesh) {
  std::set<std::set<int>> out;
  for (const Tet& tet : tets_of(mesh)) out.insert({tet.begin(), tet.end()});
  return out;
}

// The area of triangles, which must all lie in the plane where coordinate i is x.
double area_in_plane(const Mesh& mesh, const std::string& surface, Eigen::Index i, double x) {
  double sum = 0;
  for (const FaceCorners& t : mesh.surfaces.at(surface)) {
    const auto node = [&](std::size_t k) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(t[k])]; };
    for (const std::size_t k : {0u, 1u, 2u}) EXPECT_EQ(node(k)[i], x);
    sum += (node(1) - node(0)).cross(node(2) - node(0)).norm() / 2;
  }
  return sum;
}

class InAnyFormat : public testing::TestWithParam<Format> {
 protected:
  static LoadedMesh load() { return GetParam().read("cells", *GetParam().text, FileCells::split); }
};

TEST_P(InAnyFormat, LinearCellsStayAsTheyAre) {
  const LoadedMesh loaded = GetParam().read("cells", *GetParam().text, FileCells::keep);
  EXPECT_EQ(loaded.mesh.cells.shapes(), (std::vector{CellShape::hex8, CellShape::wedge6, CellShape::wedge6}));
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += cell_volume(loaded.mesh, c);
  EXPECT_NEAR(sum, 2, 1e-15);
  EXPECT_TRUE(loaded.mesh.cell_of.empty());
}

TEST_P(InAnyFormat, SplitMeshesAreTheSame) {
  const LoadedMesh loaded = load();
  EXPECT_NEAR(volume(loaded.mesh), 2, 1e-15);
  EXPECT_EQ(boundary_faces(loaded.mesh).size(), 20u);
  EXPECT_EQ(loaded.mesh.cell_of, (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(loaded.mesh.region_of, (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(sets_of(loaded.mesh), sets_of(read_gmsh_text("cells", kGmsh22, FileCells::split).mesh));
  EXPECT_EQ(loaded.warnings.back(), "cells: 1 hexahedron and 2 wedges are split into 12 tetrahedra");
}

TEST_P(InAnyFormat, QuadrilateralsOfASurfaceBecomeTriangles) {
  const Mesh mesh = load().mesh;
  if (!GetParam().has_surfaces) {
    EXPECT_TRUE(mesh.surfaces.empty());
    return;
  }
  EXPECT_NEAR(area_in_plane(mesh, "clamped", 0, 0), 1, 1e-15);
  EXPECT_NEAR(area_in_plane(mesh, "top", 2, 1), 2, 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Hexahedra, InAnyFormat,
                         testing::Values(Format{"gmsh22", &kGmsh22, read_gmsh_text, true},
                                         Format{"gmsh41", &kGmsh41, read_gmsh_text, true},
                                         Format{"abaqus", &kAbaqus, read_abaqus_text, true},
                                         Format{"vtk", &kVtk, read_vtk_text, false},
                                         Format{"vtu", &kVtu, read_vtu_text, false}),
                         [](const auto& test) { return test.param.name; });

TEST(Hexahedra, NamesOfRegionsStay) {
  for (const auto& text : {kGmsh22, kGmsh41})
    EXPECT_EQ(read_gmsh_text("cells", text).mesh.region_names, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(read_abaqus_text("cells", kAbaqus).mesh.region_names, (std::vector<std::string>{"left", "right"}));
}

TEST(Hexahedra, CubesOfVegaCanBeSplit) {
  const LoadedMesh loaded = read_vega_text("cells.veg", kVega, FileCells::split);
  EXPECT_NEAR(volume(loaded.mesh), 2, 1e-15);
  EXPECT_EQ(loaded.warnings, Warnings{"cells.veg: 2 hexahedra are split into 12 tetrahedra"});
  EXPECT_CONTAINS(refusal_of([&] { read_vega_text("cells.veg", replaced(kVega, "2 8\n", "2 4\n")); }),
                  "cells.veg:17: 4 numbers per line; expected 8");
}

// The normal of a wedge's base is outward in VTK's manual, inward in some files.
TEST(Hexahedra, WedgesOfVtkMayCountEitherWay) {
  const std::string inward = replaced(replaced(kVtk, "5 10 11 1 8 9", "1 8 9 5 10 11"), "5 11 6 1 9 2", "1 9 2 5 11 6");
  EXPECT_EQ(read_vtk_text("cells", inward).mesh.cells, read_vtk_text("cells", kVtk).mesh.cells);
}

TEST(Hexahedra, VoxelsCountTheirNodesRowByRow) {
  const std::string voxel = replaced(replaced(kVtk, "8 0 1 2 3 4 5 6 7", "8 0 1 3 2 4 5 7 6"), "9 12", "8 11");
  EXPECT_EQ(read_vtk_text("cells", voxel).mesh.cells, read_vtk_text("cells", kVtk).mesh.cells);
}

TEST(Hexahedra, EveryTetHasTheCellDataOfItsElement) {
  for (const LoadedMesh& loaded :
       {read_vtk_text("cells", kVtk, FileCells::split), read_vtu_text("cells", kVtu, FileCells::split)}) {
    const CellData* angle = find_cell_data(loaded, "angle");
    ASSERT_TRUE(angle);
    EXPECT_EQ(angle->values, (std::vector<double>{10, 11, 10, 11, 10, 11, 10, 11, 10, 11, 10, 11,
                                                  20, 21, 20, 21, 20, 21, 30, 31, 30, 31, 30, 31}));
  }
}

// A pyramid in every format, with a tet on a triangular face.
TEST(Hexahedra, PyramidsAreRead) {
  const std::string nodes = "1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 3\n";
  const LoadedMesh abaqus = read_abaqus_text(
      "p.inp", "*NODE\n" + nodes + "*ELEMENT, TYPE=C3D5, ELSET=all\n1, 1, 2, 3, 4, 5\n*SURFACE, NAME=side\nall, S2\n");
  EXPECT_NEAR(volume(abaqus.mesh), 1, 1e-15);
  EXPECT_EQ(sets_of(abaqus.mesh), (std::set<std::set<int>>{{0, 1, 2, 4}, {0, 2, 3, 4}}));
  EXPECT_EQ(abaqus.mesh.surfaces.at("side"), (std::vector<FaceCorners>{{0, 1, 4}}));
  const LoadedMesh vtk = read_vtk_text(
      "p.vtk",
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 3\n"
      "CELLS 1 6\n5 0 1 2 3 4\nCELL_TYPES 1\n14\n");
  EXPECT_EQ(vtk.mesh.cells, abaqus.mesh.cells);
}

TEST(Hexahedra, OnesThatStandForWedgesAreSplitAsThese) {
  const std::string collapsed =
      replaced(replaced(kAbaqus, "C3D6", "C3D8"), "6, 2, 9, 10, 6, 11, 12\n7, 2, 10, 3, 6, 12, 7",
               "6, 2, 9, 10, 10, 6, 11, 12, 12\n7, 2, 10, 3, 3, 6, 12, 7, 7");
  const LoadedMesh loaded = read_abaqus_text("cells", replaced(collapsed, "right, S2\n", "6, S2\n7, S2\n"));
  EXPECT_EQ(sets_of(loaded.mesh), sets_of(read_abaqus_text("cells", kAbaqus, FileCells::split).mesh));
  EXPECT_EQ(loaded.mesh.surfaces.at("top").size(), 4u);
}

// Some elements of the file are inverted, others are not.
TEST(Hexahedra, InvertedOnesAreTurnedAndTold) {
  const auto expect_turned = [](const LoadedMesh& loaded, const std::string& message) {
    double sum = 0;
    for (std::size_t c = 0; c < loaded.mesh.cells.size(); ++c) sum += cell_volume(loaded.mesh, c);
    EXPECT_NEAR(sum, 2, 1e-14);
    EXPECT_CONTAINS(join(loaded.warnings), message + "; they were reoriented");
  };
  expect_turned(read_gmsh_text("a.msh", replaced(kGmsh22, "1 2 3 4 5 6 7 8\n", "5 6 7 8 1 2 3 4\n")),
                "a.msh:32: 1 of 3 elements list their nodes in inverted order, the first is element 5");
  expect_turned(read_gmsh_text("a.msh", replaced(kGmsh41, "2 9 10 6 11 12", "6 11 12 2 9 10")),
                "a.msh:59: 1 of 3 elements list their nodes in inverted order, the first is element 6");
  expect_turned(read_abaqus_text("a.inp", replaced(kAbaqus, "2, 9, 10, 6, 11, 12", "6, 11, 12, 2, 9, 10")),
                "a.inp:18: 1 of 3 elements list their nodes in inverted order, the first is element 6");
  expect_turned(read_vtk_text("a.vtk", replaced(kVtk, "0 1 2 3 4 5 6 7", "4 5 6 7 0 1 2 3")),
                "a.vtk: 1 of 3 elements list their nodes in inverted order, the first is element 1");
}

// A corner is pushed through the hexahedron: it is inverted in part, so reorienting cannot repair it.
TEST(Hexahedra, OnesThatAreInvertedInPartAreRefusedWithTheirLine) {
  const std::string pushed = replaced(kAbaqus, "\n8, 0, 1, 1", "\n8, 2, -3, -2");
  EXPECT_CONTAINS(refusal_of([&] { read_abaqus_text("a.inp", pushed); }), "a.inp:15: element 5: folded over");
  EXPECT_CONTAINS(refusal_of([&] { read_abaqus_text("a.inp", pushed, FileCells::split); }), "inverted");
}

TEST(Hexahedra, AFaceThatAnElementDoesNotHaveIsRefused) {
  EXPECT_CONTAINS(refusal_of([] { read_abaqus_text("a.inp", replaced(kAbaqus, "right, S2", "right, S6")); }),
                  "a.inp:24: surface \"top\": S6 of element 6; a wedge has S1 to S5");
}

TEST(Hexahedra, WithTooFewNodesAreRefused) {
  EXPECT_CONTAINS(refusal_of([] { read_gmsh_text("a.msh", replaced(kGmsh22, "5 6 7 8\n6", "5 6 7\n6")); }),
                  "a.msh:32: expected a node tag");
  EXPECT_CONTAINS(refusal_of([] { read_vtu_text("a.vtu", replaced(kVtu, "12 13 13", "12 12 13")); }),
                  "a.vtu: cell 1: a hexahedron (type 12) of 6 points; expected 8");
  EXPECT_CONTAINS(refusal_of([] { read_abaqus_text("a.inp", replaced(kAbaqus, "C3D8R", "C3D13V")); }),
                  "a.inp:14: element type C3D13V is not supported; supported solid elements: tetrahedra");
  for (const char* unknown : {"C3D8X", "C3D8RR", "C3D8HR", "C3D9"}) {
    const std::string message = refusal_of([&] { read_abaqus_text("a.inp", replaced(kAbaqus, "C3D8R", unknown)); });
    EXPECT_CONTAINS(message, "element type " + std::string(unknown));
    EXPECT_CONTAINS(message, "hexahedra (C3D8, C3D8H, C3D8I, C3D8IH, C3D8R, C3D8RH,");
  }
}

}  // namespace
}  // namespace orthodyn::hexahedra_test
