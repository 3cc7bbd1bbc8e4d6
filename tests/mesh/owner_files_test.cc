// Files written by Gmsh, TetGen and meshio: see data/README.md.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "lib/mesh/io/gmsh.h"
#include "lib/mesh/io/mesh_file.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/io/vtk.h"
#include "tests/mesh/refusal.h"
#include "tests/mesh/tets.h"

namespace orthodyn::owner_files_test {
namespace {

LoadedMesh load(const std::string& name, FileCells cells = FileCells::keep) {
  return read_mesh(std::string(ORTHODYN_SOURCE_DIR) + "/tests/mesh/data/" + name, cells);
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) sum += cell_volume(mesh, e);
  return sum;
}

double area(const Mesh& mesh, const std::vector<FaceCorners>& triangles) {
  double sum = 0;
  for (const FaceCorners& t : triangles) {
    const auto x = [&](std::size_t k) -> const Vec3& { return mesh.node(t[k]); };
    sum += (x(1) - x(0)).cross(x(2) - x(0)).norm() / 2;
  }
  return sum;
}

class TwoBoxes : public testing::TestWithParam<const char*> {};

TEST_P(TwoBoxes, AreTwoCubesWideAndSplitInHalf) {
  const Mesh mesh = load(GetParam()).mesh;
  EXPECT_EQ(mesh.nodes.size(), 23u);
  EXPECT_NEAR(volume(mesh), 2, 1e-12);
  const bool has_groups = std::string(GetParam()) != "two_boxes_gmsh.vtk";  // Gmsh writes none into it
  ASSERT_EQ(mesh.region_names.size(), has_groups ? 2u : 1u);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const double x = centroid(mesh, static_cast<int>(e))[0];
    EXPECT_EQ(mesh.region_of[e], has_groups && x > 1 ? 1 : 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Written, TwoBoxes,
                         testing::Values("two_boxes_22.msh", "two_boxes_41.msh", "two_boxes_gmsh.inp",
                                         "two_boxes_gmsh.vtk", "two_boxes_meshio_ascii.vtu",
                                         "two_boxes_meshio_zlib.vtu", "two_boxes_meshio_ascii.vtk",
                                         "two_boxes_meshio_binary.vtk"));

// Gmsh wrote each once as text and once as bytes.
TEST(OwnerFiles, BinaryGmshFilesAreThoseInAscii) {
  for (const std::string version : {"22", "41"}) {
    const LoadedMesh text = load("two_boxes_" + version + ".msh"), bytes = load("two_boxes_" + version + "_binary.msh");
    ASSERT_EQ(bytes.mesh.nodes.size(), text.mesh.nodes.size());
    for (std::size_t n = 0; n < text.mesh.nodes.size(); ++n)
      EXPECT_LT((bytes.mesh.nodes[n] - text.mesh.nodes[n]).norm(), 1e-14);
    EXPECT_EQ(bytes.mesh.cells, text.mesh.cells);
    EXPECT_EQ(bytes.mesh.region_of, text.mesh.region_of);
    EXPECT_EQ(bytes.mesh.region_names, text.mesh.region_names);
    EXPECT_EQ(bytes.mesh.surfaces, text.mesh.surfaces);
    EXPECT_EQ(bytes.mesh.node_sets, text.mesh.node_sets);
  }
}

// 2.1 is read as 2.2; in 2.0, names of physical groups have no dimension.
TEST(OwnerFiles, OlderGmshFilesAreThoseOf22) {
  const std::string path = std::string(ORTHODYN_SOURCE_DIR) + "/tests/mesh/data/two_boxes_22.msh";
  const std::string now = read_text_file(path);
  const Mesh mesh = load("two_boxes_22.msh").mesh;
  const Mesh of21 = read_gmsh_text("a.msh", replaced(now, "\n2.2 0", "\n2.1 0")).mesh;
  EXPECT_EQ(of21.cells, mesh.cells);
  EXPECT_EQ(of21.region_names, mesh.region_names);
  const std::size_t begin = now.find("$PhysicalNames"), end = now.find("$EndPhysicalNames");
  std::string section = now.substr(begin, end - begin), without;
  for (std::size_t at = 0, line = 0; at < section.size(); ++line) {
    const std::size_t next = section.find('\n', at) + 1;
    without += section.substr(at + (line > 1 ? section.find(' ', at) - at + 1 : 0),
                              next - at - (line > 1 ? section.find(' ', at) - at + 1 : 0));
    at = next;
  }
  const Mesh of20 = read_gmsh_text("a.msh", replaced(replaced(now, "\n2.2 0", "\n2 0"), section, without)).mesh;
  EXPECT_EQ(of20.region_names, mesh.region_names);
  EXPECT_EQ(of20.surfaces, mesh.surfaces);
  EXPECT_EQ(of20.node_sets, mesh.node_sets);
}

// Color tables between the arrays, which are bytes in a binary file.
TEST(OwnerFiles, TablesOfColorsInVtkFilesAreSkipped) {
  const std::string head =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
      "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nCELL_DATA 1\n";
  const std::string region = "SCALARS region int 1\nLOOKUP_TABLE colors\n3\n";
  const std::string colors = "LOOKUP_TABLE colors 2\n0 0 0 1\n1 1 1 1\nCOLOR_SCALARS rgb 3\n0.5 0.5 1\n";
  for (const std::string& text : {head + region + colors, head + colors + region})
    EXPECT_EQ(read_vtk_text("a.vtk", text).mesh.region_names, std::vector<std::string>{"region3"});
  const std::string binary =
      read_text_file(std::string(ORTHODYN_SOURCE_DIR) + "/tests/mesh/data/two_boxes_meshio_binary.vtk") +
      "LOOKUP_TABLE colors 2\n" + std::string("\0\0\0\1\n\xff\xff$", 8) + "\n";
  EXPECT_EQ(read_vtk_text("a.vtk", binary).mesh.cells, load("two_boxes_meshio_binary.vtk").mesh.cells);
}

TEST(OwnerFiles, EveryKindOfVtkFileGivesTheSameMeshAndCellData) {
  const LoadedMesh first = load("two_boxes_meshio_ascii.vtu");
  EXPECT_EQ(first.mesh.region_names, (std::vector<std::string>{"region1", "region2"}));
  for (const char* name : {"two_boxes_meshio_zlib.vtu", "two_boxes_meshio_ascii.vtk", "two_boxes_meshio_binary.vtk"}) {
    const LoadedMesh other = load(name);
    EXPECT_EQ(other.mesh.nodes, first.mesh.nodes) << name;
    EXPECT_EQ(other.mesh.cells, first.mesh.cells) << name;
    EXPECT_EQ(other.mesh.region_of, first.mesh.region_of) << name;
    ASSERT_TRUE(find_cell_data(other, "gmsh:physical")) << name;
    EXPECT_EQ(find_cell_data(other, "gmsh:physical")->values, find_cell_data(first, "gmsh:physical")->values) << name;
  }
}

// Two cubes of edge 1: 8 hexahedra beside 16 wedges.
class Bricks : public testing::TestWithParam<const char*> {};

TEST_P(Bricks, AreTwoCubesSplitIntoTets) {
  const std::string name = GetParam();
  const LoadedMesh loaded = load(name, FileCells::split);
  const Mesh& mesh = loaded.mesh;
  const bool is_quadratic = name.find("_o2") != std::string::npos;
  EXPECT_EQ(mesh.order(), is_quadratic ? 2 : 1);
  std::set<int> corners;
  for (const Tet& tet : tets_of(mesh)) corners.insert(tet.begin(), tet.end());
  EXPECT_EQ(corners.size(), 45u);
  EXPECT_EQ(mesh.cells.size(), 8u * 6 + 16u * 3);
  EXPECT_NEAR(volume(mesh), 2, 1e-12);
  EXPECT_EQ(boundary_faces(mesh).size(), 10u * 8);
  EXPECT_CONTAINS(
      loaded.warnings.at(name.ends_with(".vtk") ? 1 : 0),
      fmt::format("8 hexahedra and 16 wedges are split into 96 {}tetrahedra", is_quadratic ? "quadratic " : ""));
  if (name.ends_with(".vtk")) return;  // Gmsh writes no groups into it
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"left", "right"}));
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const double x = centroid(mesh, static_cast<int>(e))[0];
    EXPECT_EQ(mesh.region_of[e], x > 1 ? 1 : 0);
  }
  EXPECT_NEAR(area(mesh, mesh.surfaces.at("clamped")), 1, 1e-12);
  EXPECT_NEAR(area(mesh, mesh.surfaces.at("top")), 2, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Written, Bricks,
                         testing::Values("bricks_22.msh", "bricks_41.msh", "bricks_gmsh.inp", "bricks_gmsh.vtk",
                                         "bricks_o2_22.msh", "bricks_o2_gmsh.vtk"));

TEST(OwnerFiles, PhysicalGroupsOfGmshComeThroughItsAbaqusFile) {
  const Mesh msh = load("two_boxes_41.msh").mesh;
  const Mesh inp = load("two_boxes_gmsh.inp").mesh;
  EXPECT_EQ(inp.region_names, msh.region_names);
  EXPECT_EQ(inp.region_of, msh.region_of);
  EXPECT_EQ(inp.surfaces.at("clamped"), msh.surfaces.at("clamped"));
  EXPECT_NEAR(area(inp, inp.surfaces.at("clamped")), 1, 1e-14);
}

TEST(OwnerFiles, TetGensMarkersAndAttributesAreSurfacesNodeSetsAndRegions) {
  const Mesh mesh = load("cube.ele").mesh;
  EXPECT_NEAR(volume(mesh), 1, 1e-14);
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"region7"});
  EXPECT_NEAR(area(mesh, mesh.surfaces.at("marker1")), 1, 1e-14);
  EXPECT_NEAR(area(mesh, mesh.surfaces.at("marker3")), 4, 1e-14);
  for (const int n : mesh.node_sets.at("marker2")) EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(n)][0], 1);
  EXPECT_EQ(mesh.node_sets.at("marker2").size(), 4u);
  EXPECT_EQ(load("cube.node").mesh.cells, mesh.cells);
}

TEST(OwnerFiles, MeshioKeepsTheMeshOfTetGen) {
  const Mesh mesh = load("cube.ele").mesh;
  for (const char* name : {"cube_meshio.inp", "cube_meshio_binary.vtu"}) {
    EXPECT_EQ(load(name).mesh.nodes, mesh.nodes) << name;
    EXPECT_EQ(load(name).mesh.cells, mesh.cells) << name;
  }
}

TEST(MeshFile, AnUnknownEndingIsRefusedWithTheKnownOnes) {
  const std::string message = refusal_of([] { read_mesh("body.stl"); });
  EXPECT_CONTAINS(message, "body.stl: no mesh format has the ending \".stl\"; known: ");
  for (const char* known : {".msh (Gmsh)", ".msh2 (Gmsh 2.2)", ".node (TetGen), .ele (TetGen)", ".inp (Abaqus)",
                            ".vtu (VTK XML)", ".vtk (VTK legacy)", ".veg (Vega)"}) {
    EXPECT_CONTAINS(message, known);
  }
}

}  // namespace
}  // namespace orthodyn::owner_files_test
