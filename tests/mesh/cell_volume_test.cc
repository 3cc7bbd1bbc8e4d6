// Volumes of solid elements by their shape functions, before and after splitting into tetrahedra.
#include "lib/mesh/cell_volume.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "lib/core/spelling.h"
#include "lib/mesh/io/gmsh.h"
#include "lib/mesh/io/vtk.h"
#include "lib/mesh/split_cells.h"
#include "tests/mesh/refusal.h"
#include "tests/mesh/tets.h"

namespace orthodyn::cell_volume_test {
namespace {

struct Solid {
  CellKind kind;
  std::vector<Vec3> corners;
  double volume;
};
void PrintTo(const Solid& solid, std::ostream* os) { *os << name_of(solid.kind); }

const Solid kSolids[] = {{CellKind::tet, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1. / 6},
                         {CellKind::pyramid, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}, 1. / 3},
                         {CellKind::wedge, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, 1. / 2},
                         {CellKind::hexahedron,
                          {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                          1}};

// A quadratic element with nodes mapped from a unit solid by `map`; `complete`: with nodes within faces.
struct Element {
  FileCell cell;
  std::vector<Vec3> nodes;

  Element(const Solid& solid, bool quadratic, bool complete, const std::function<Vec3(const Vec3&)>& map)
      : cell{.kind = solid.kind} {
    const auto add = [&](const Vec3& x) {
      nodes.push_back(map(x));
      return static_cast<std::int64_t>(nodes.size()) - 1;
    };
    for (std::size_t k = 0; k < solid.corners.size(); ++k) cell.nodes[k] = add(solid.corners[k]);
    if (!quadratic) return;
    if (cell.kind == CellKind::tet) {
      cell.midsides.emplace();
      for (std::size_t e = 0; e < 6; ++e)
        (*cell.midsides)[e] = add((solid.corners[kTetEdges[e][0]] + solid.corners[kTetEdges[e][1]]) / 2);
      return;
    }
    for (const auto& [a, b] : edges_of(cell.kind))
      cell.edges.push_back({cell.nodes[a], cell.nodes[b], add((solid.corners[a] + solid.corners[b]) / 2)});
    for (const CornerIndices& face : faces_of(cell.kind))
      if (complete && face.size() == 4)
        cell.add_face_middle({face[0], face[1], face[2], face[3]},
                             add((solid.corners[face[0]] + solid.corners[face[2]]) / 2));
  }

  double volume() const {
    return volume_of(cell, [&](std::int64_t n) -> const Vec3& { return nodes[static_cast<std::size_t>(n)]; });
  }
};

class AnyElement : public testing::TestWithParam<Solid> {};
INSTANTIATE_TEST_SUITE_P(CellVolume, AnyElement, testing::ValuesIn(kSolids),
                         [](const auto& test) { return std::string(name_of(test.param.kind)); });

// Linear maps scale the volume by their determinant; the quadratic map has determinant 1 and is in the span of all
// quadratic shape functions.
TEST_P(AnyElement, HasTheVolumeOfTheMapOfItsNodes) {
  const Solid& solid = GetParam();
  Mat3 A;
  A << 2, 0.3, 0.1, -0.2, 1, 0.4, 0.5, 0.1, 3;
  const auto linear = [&](const Vec3& x) -> Vec3 { return A * x + Vec3(5, 6, 7); };
  const auto bent = [](const Vec3& x) -> Vec3 { return {x[0] + 0.3 * x[1] * x[1], x[1] + 0.2 * x[2] * x[2], x[2]}; };
  for (const bool complete : {false, true}) {
    EXPECT_NEAR(Element(solid, true, complete, linear).volume(), A.determinant() * solid.volume, 1e-12);
    EXPECT_NEAR(Element(solid, true, complete, bent).volume(), solid.volume, 1e-14);
  }
  EXPECT_NEAR(Element(solid, false, false, linear).volume(), A.determinant() * solid.volume, 1e-12);
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Tet& tet : tets_of(mesh)) sum += signed_volume6(mesh, tet) / 6;
  return sum;
}

// Corners, mid-edge nodes, and in each quadrilateral a node displaced outward by 0.1, in the order of a format.
std::vector<Vec3> bulging(const Solid& solid, const std::vector<std::array<std::size_t, 2>>& edges,
                          const std::vector<std::array<std::size_t, 4>>& faces, bool has_centre) {
  std::vector<Vec3> nodes = solid.corners;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& x : solid.corners) centre += x / static_cast<double>(solid.corners.size());
  for (const auto& [a, b] : edges) nodes.push_back((nodes[a] + nodes[b]) / 2);
  for (const auto& f : faces) {
    const Vec3 middle = (nodes[f[0]] + nodes[f[2]]) / 2;
    Vec3 normal = (nodes[f[2]] - nodes[f[0]]).cross(nodes[f[3]] - nodes[f[1]]).normalized();
    if (normal.dot(middle - centre) < 0) normal = -normal;
    nodes.push_back(middle + 0.1 * normal);
  }
  if (has_centre) nodes.push_back(centre);
  return nodes;
}

std::string rows(const std::vector<Vec3>& nodes, bool numbered) {
  std::string text;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    text += (numbered ? std::to_string(n + 1) + " " : "") +
            fmt::format("{} {} {}\n", nodes[n][0], nodes[n][1], nodes[n][2]);
  return text;
}

std::string counted_from(std::size_t first, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += " " + std::to_string(first + k);
  return text;
}

LoadedMesh from_gmsh(int type, const std::vector<Vec3>& nodes) {
  return read_gmsh_text(
      "a.msh",
      fmt::format(
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n{}$EndNodes\n$Elements\n1\n1 {} 2 0 1{}\n$EndElements\n",
          nodes.size(), rows(nodes, true), type, counted_from(1, nodes.size())),
      FileCells::split);
}

LoadedMesh from_vtk(int type, const std::vector<Vec3>& nodes) {
  return read_vtk_text("a.vtk",
                       fmt::format("# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
                                   "{} double\n{}CELLS 1 {}\n{}{}\nCELL_TYPES 1\n{}\n",
                                   nodes.size(), rows(nodes, false), nodes.size() + 1, nodes.size(),
                                   counted_from(0, nodes.size()), type),
                       FileCells::split);
}

// All nodes except a centre are nodes of the mesh; a wrong node order would fold elements or change the boundary.
void expect_kept(const LoadedMesh& loaded, const std::vector<Vec3>& nodes, bool has_centre) {
  std::size_t found = 0;
  for (const Vec3& x : nodes)
    for (const Vec3& y : loaded.mesh.nodes) found += (x - y).norm() < 1e-14;
  EXPECT_GE(found, nodes.size() - (has_centre ? 1 : 0));
  EXPECT_CONTAINS(join(loaded.warnings), "by their shape functions");
}

using Edges = std::vector<std::array<std::size_t, 2>>;
using Faces = std::vector<std::array<std::size_t, 4>>;
const Edges kGmshHex{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
const Edges kGmshWedge{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}};
const Edges kGmshPyramid{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};
const Faces kGmshHexFaces{{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
const Faces kGmshWedgeFaces{{0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}};
const Faces kVtkHexFaces{{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};

// The 27 shape functions give 1 + 6 (4/9) 0.1, the quadratic tets 1 + 6 (1/3) 0.1, as a diagonal cuts each face in two.
TEST(CellVolume, ABulgingHexahedronKeepsItsNodesWhenItIsSplit) {
  const auto gmsh = bulging(kSolids[3], kGmshHex, kGmshHexFaces, true);
  const auto vtk = bulging(kSolids[3], edges_of(CellKind::hexahedron), kVtkHexFaces, true);
  for (const LoadedMesh& loaded : {from_gmsh(12, gmsh), from_vtk(29, vtk)}) {
    expect_kept(loaded, gmsh, true);
    EXPECT_CONTAINS(join(loaded.warnings),
                    "a volume of 1.26667 by their shape functions, the tetrahedra that replace them 1.2 (-5.3 %)");
    EXPECT_NEAR(volume(loaded.mesh), 1, 1e-14);  // of their corners
  }
}

TEST(CellVolume, BulgingWedgesAndPyramidsKeepTheirNodesWhenTheyAreSplit) {
  const auto gmsh = bulging(kSolids[2], kGmshWedge, kGmshWedgeFaces, false);
  expect_kept(from_gmsh(13, gmsh), gmsh, false);
  const auto vtk = bulging(kSolids[2], edges_of(CellKind::wedge), {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}, false);
  expect_kept(from_vtk(32, vtk), vtk, false);
  const auto pyramid = bulging(kSolids[1], kGmshPyramid, {{0, 3, 2, 1}}, false);
  expect_kept(from_gmsh(14, pyramid), pyramid, false);
}

TEST(CellVolume, PlaneFacesTellNothing) {
  const LoadedMesh loaded = from_gmsh(5, kSolids[3].corners);
  EXPECT_EQ(join(loaded.warnings), "a.msh: 1 hexahedron is split into 6 tetrahedra");
}

}  // namespace
}  // namespace orthodyn::cell_volume_test
