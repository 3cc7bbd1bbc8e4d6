#include "lib/mesh/io/medit.h"

#include <gtest/gtest.h>

#include "lib/mesh/io/mesh_file.h"
#include "lib/mesh/quadratic.h"
#include "tests/mesh/refusal.h"

namespace orthodyn::medit_test {
namespace {

// A prism with a tetrahedron on its upper triangle.
const std::string kMesh = R"(MeshVersionFormatted 2
# a comment
Dimension
3
Vertices
7
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 4
1 0 1 4
0 1 1 4
0 0 2 0
Tetrahedra 1
4 5 6 7 2
Prisms
1
1 2 3 4 5 6 1
Triangles
2
1 2 3 5
4 5 7 0
Corners
2
1
2
End
)";

LoadedMesh load(const std::string& text) { return read_medit_text("body.mesh", text); }
std::string refusal(const std::string& text) {
  return refusal_of([&] { load(text); });
}
double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) sum += cell_volume(mesh, e);
  return sum;
}

TEST(Medit, ReferencesAreRegionsSurfacesAndNodeSets) {
  const LoadedMesh loaded = load(kMesh);
  EXPECT_EQ(loaded.mesh.region_names, (std::vector<std::string>{"region2", "region1"}));
  EXPECT_NEAR(volume(loaded.mesh), 1. / 2 + 1. / 6, 1e-15);
  ASSERT_EQ(loaded.mesh.surfaces.size(), 1u);
  EXPECT_EQ(loaded.mesh.surfaces.at("surface5").size(), 1u);
  EXPECT_EQ(loaded.mesh.node_sets.at("vertices4"), (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(loaded.mesh.nodes[6], Vec3(0, 0, 2));
}

TEST(Medit, SectionsThatAreSkippedAreNamed) {
  const LoadedMesh loaded = load(kMesh);
  ASSERT_FALSE(loaded.warnings.empty());
  EXPECT_CONTAINS(loaded.warnings[0], "body.mesh: only the mesh is read; skipped: Corners");
}

TEST(Medit, HexahedraAreReadAsAbaqusNumbersThem) {
  EXPECT_NEAR(
      volume(load("MeshVersionFormatted 1\nDimension 3\nVertices 8\n0 0 0 0\n2 0 0 0\n2 1 0 0\n0 1 0 0\n0 0 1 0\n"
                  "2 0 1 0\n2 1 1 0\n0 1 1 0\nHexahedra 1\n1 2 3 4 5 6 7 8 0\nEnd\n")
                 .mesh),
      2, 1e-15);
}

// Mid-edge nodes are assigned to their edges, whatever their order in the file.
TEST(Medit, QuadraticTetrahedraHaveTheirMiddleNodesOnTheirEdges) {
  const std::string head =
      "MeshVersionFormatted 2\nDimension 3\nVertices 10\n0 0 0 0\n2 0 0 0\n0 2 0 0\n0 0 2 0\n1 0 0 0\n"
      "1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n0 1 1 0\nTetrahedraP2 1\n1 2 3 4 ";
  for (const char* middles : {"5 6 7 8 9 10", "5 6 7 8 10 9"}) {
    const Mesh mesh = load(head + middles + " 1\nEnd\n").mesh;
    ASSERT_EQ(mesh.order(), 2);
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const auto node = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
      const Vec3 half = 0.5 * (node(mesh.cells[0][kTetEdges[e][0]]) + node(mesh.cells[0][kTetEdges[e][1]]));
      EXPECT_EQ(node(mesh.cells[0][4 + e]), half) << middles;
    }
  }
}

TEST(Medit, RefusalsNameLineAndRemedy) {
  EXPECT_CONTAINS(refusal("MFEM mesh v1.0\n"), "body.mesh:1: expected MeshVersionFormatted");
  EXPECT_CONTAINS(refusal(replaced(kMesh, "Dimension\n3", "Dimension\n2")), "dimension 2; expected 3");
  EXPECT_CONTAINS(refusal(replaced(kMesh, "4 5 6 7 2", "4 5 6 9 2")), "body.mesh:15: ");
  EXPECT_CONTAINS(refusal(replaced(kMesh, "4 5 6 7 2", "4 5 6 7")), "body.mesh:15: expected a reference");
  EXPECT_CONTAINS(refusal(replaced(kMesh, "Tetrahedra 1", "TetrahedraP3 1")),
                  "elements TetrahedraP3 are not supported");
  EXPECT_CONTAINS(refusal(replaced(kMesh, "Vertices\n7", "Vertices\n6")), "expected a keyword, found \"0\"");
  EXPECT_CONTAINS(refusal(kMesh.substr(0, kMesh.find("1 0 1 4"))), "the file ends after 4 of 7 Vertices");
  EXPECT_CONTAINS(refusal_of([] { read_mesh("body.meshb"); }), "binary Medit files are not supported");
  EXPECT_CONTAINS(refusal_of([] { read_mesh("body.med"); }), "meshio.write('body.vtu', meshio.read('body.med'))");
}

}  // namespace
}  // namespace orthodyn::medit_test
