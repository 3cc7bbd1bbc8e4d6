// Hexahedra, wedges and pyramids are split into tetrahedra that fill them and match across common faces.
#include "lib/mesh/split_cells.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "lib/mesh/mesh_draft.h"
#include "lib/mesh/quadratic.h"
#include "tests/mesh/refusal.h"
#include "tests/mesh/tets.h"

namespace orthodyn::split_cells_test {
namespace {

using Nodes = std::vector<int>;

// A unit solid with its faces, listed independently of the code under test.
struct Solid {
  CellKind kind;
  std::vector<Vec3> corners;
  std::vector<Nodes> faces;  // counterclockwise from outside
  std::set<std::size_t> tets;
};
void PrintTo(const Solid& solid, std::ostream* os) { *os << name_of(solid.kind); }

const Solid kSolids[] = {{CellKind::pyramid,
                          {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4, 0.6, 1}},
                          {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
                          {2}},
                         {CellKind::wedge,
                          {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                          {{2, 1, 0}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
                          {3}},
                         {CellKind::hexahedron,
                          {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                          {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
                          {5, 6}}};

double volume(const std::vector<Tet>& tets, const std::vector<Vec3>& nodes) {
  Mesh mesh;
  mesh.nodes = nodes;
  double sum = 0;
  for (const Tet& tet : tets) sum += signed_volume6(mesh, tet) / 6;
  return sum;
}

// Volume by the divergence theorem; faces are cut by the diagonal through their smallest node.
double volume_within(const std::vector<Nodes>& faces, const Nodes& numbers, const std::vector<Vec3>& nodes) {
  double sum = 0;
  for (const Nodes& face : faces) {
    Nodes f;
    for (const int k : face) f.push_back(numbers[static_cast<std::size_t>(k)]);
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    const auto x = [&](std::size_t k) -> const Vec3& { return nodes[static_cast<std::size_t>(f[k])]; };
    for (std::size_t k = 2; k < f.size(); ++k) sum += x(0).dot(x(k - 1).cross(x(k))) / 6;
  }
  return sum;
}

class AnySolid : public testing::TestWithParam<Solid> {};
INSTANTIATE_TEST_SUITE_P(Split, AnySolid, testing::ValuesIn(kSolids),
                         [](const auto& test) { return std::string(name_of(test.param.kind)); });

TEST_P(AnySolid, WithWarpedFacesAndAnyNumbersHasItsVolumeInPositiveTets) {
  const Solid& solid = GetParam();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.1, 0.1);
  std::set<std::size_t> counts;
  for (int trial = 0; trial < 500; ++trial) {
    Nodes numbers(solid.corners.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    std::shuffle(numbers.begin(), numbers.end(), random);
    std::vector<Vec3> nodes(numbers.size());
    for (std::size_t k = 0; k < numbers.size(); ++k)
      nodes[static_cast<std::size_t>(numbers[k])] =
          solid.corners[k] + Vec3(shift(random), shift(random), shift(random));
    std::vector<Tet> tets;
    ASSERT_TRUE(append_tets(solid.kind, numbers, tets));
    counts.insert(tets.size());
    EXPECT_NEAR(volume(tets, nodes), volume_within(solid.faces, numbers, nodes), 1e-14);
    for (const Tet& tet : tets) EXPECT_GT(volume({tet}, nodes), 0);
  }
  EXPECT_EQ(counts, solid.tets);
}

// Abaqus lists the corners of faces clockwise from outside.
TEST_P(AnySolid, HasTheFacesOfItsCorners) {
  const Solid& solid = GetParam();
  const auto& faces = faces_of(solid.kind);
  ASSERT_EQ(faces.size(), solid.faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Nodes found(faces[f].rbegin(), faces[f].rend()), expected = solid.faces[f];
    std::rotate(found.begin(), std::min_element(found.begin(), found.end()), found.end());
    std::rotate(expected.begin(), std::min_element(expected.begin(), expected.end()), expected.end());
    EXPECT_EQ(found, expected) << f;
  }
}

struct Collapsed {
  const char* name;
  Nodes corners;  // of a hexahedron, in the unit cube's corners
  double volume;
};
class ACollapsedHexahedron : public testing::TestWithParam<Collapsed> {};

TEST_P(ACollapsedHexahedron, HasTheVolumeOfWhatItStandsFor) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    Nodes order(8), numbers;
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    std::vector<Vec3> nodes(8);
    for (std::size_t k = 0; k < 8; ++k) nodes[static_cast<std::size_t>(order[k])] = kSolids[2].corners[k];
    for (const int k : GetParam().corners) numbers.push_back(order[static_cast<std::size_t>(k)]);
    std::vector<Tet> tets;
    ASSERT_TRUE(append_tets(CellKind::hexahedron, numbers, tets));
    EXPECT_NEAR(volume(tets, nodes), GetParam().volume, 1e-14);
    for (const Tet& tet : tets) EXPECT_GT(volume({tet}, nodes), 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Split, ACollapsedHexahedron,
                         testing::Values(Collapsed{"wedge", {0, 1, 2, 2, 4, 5, 6, 6}, 1. / 2},
                                         Collapsed{"wedge_on_its_side", {0, 1, 2, 3, 4, 4, 7, 7}, 1. / 2},
                                         Collapsed{"pyramid", {0, 1, 2, 3, 4, 4, 4, 4}, 1. / 3},
                                         Collapsed{"tetrahedron", {0, 1, 2, 2, 5, 5, 5, 5}, 1. / 6}),
                         [](const auto& test) { return test.param.name; });

TEST(SplitCells, NodesRepeatedOtherwiseThanAlongEdgesAreRefused) {
  for (const Nodes& corners :
       {Nodes{0, 1, 0, 3, 4, 5, 6, 7}, Nodes{0, 1, 2, 3, 4, 5, 0, 7}, Nodes{0, 0, 0, 0, 4, 4, 4, 4}}) {
    std::vector<Tet> tets;
    EXPECT_FALSE(append_tets(CellKind::hexahedron, corners, tets)) << testing::PrintToString(corners);
  }
}

// n x n x n cubes of edge 1, each column of hexahedra, pairs of wedges or six pyramids; nodes numbered at random.
class Blocks {
 public:
  Blocks(int n, unsigned seed, bool mixed) : n_(n) {
    draft_.files = {"blocks.msh"};
    draft_.region_names = {"body"};
    const int corners = (n + 1) * (n + 1) * (n + 1);
    tags_.resize(static_cast<std::size_t>(corners + n * n * n));
    std::iota(tags_.begin(), tags_.end(), 1);
    std::mt19937 random(seed);
    std::shuffle(tags_.begin(), tags_.end(), random);
    for (int k = 0; k <= n; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) draft_.nodes.push_back({corner(i, j, k), {}, Vec3(i, j, k)});
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) add_cube(i, j, k, mixed ? (i + j) % 3 : 0);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (!mixed || (i + j) % 3 != 1)
          draft_.surfaces["top"].push_back(
              {.nodes = {corner(i, j, n), corner(i, j + 1, n), corner(i + 1, j + 1, n), corner(i + 1, j, n)},
               .sides = 4});
  }
  MeshDraft take() { return std::move(draft_); }

 private:
  std::int64_t corner(int i, int j, int k) const {
    return tags_[static_cast<std::size_t>((k * (n_ + 1) + j) * (n_ + 1) + i)];
  }

  void add_cube(int i, int j, int k, int as) {
    std::vector<std::int64_t> x;
    for (const Vec3& c : kSolids[2].corners)
      x.push_back(corner(i + static_cast<int>(c[0]), j + static_cast<int>(c[1]), k + static_cast<int>(c[2])));
    if (as == 0) return add(CellKind::hexahedron, x);
    if (as == 1) {
      add(CellKind::wedge, {x[0], x[1], x[2], x[4], x[5], x[6]});
      return add(CellKind::wedge, {x[0], x[2], x[3], x[4], x[6], x[7]});
    }
    const std::int64_t centre = tags_[tags_.size() - 1 - static_cast<std::size_t>((k * n_ + j) * n_ + i)];
    draft_.nodes.push_back({centre, {}, Vec3(i + 0.5, j + 0.5, k + 0.5)});
    for (const Nodes& f : kSolids[2].faces) {
      const auto at = [&](std::size_t q) { return x[static_cast<std::size_t>(f[q])]; };
      add(CellKind::pyramid, {at(3), at(2), at(1), at(0), centre});  // the normal of the base points inside
    }
  }

  void add(CellKind kind, const std::vector<std::int64_t>& corners) {
    FileCell cell{.tag = static_cast<std::int64_t>(draft_.cells.size()), .kind = kind};
    std::copy(corners.begin(), corners.end(), cell.nodes.begin());
    draft_.cells.push_back(cell);
  }

  int n_;
  std::vector<std::int64_t> tags_;
  MeshDraft draft_;
};

// validate() cannot detect a face whose two sides are cut by different diagonals: they look like boundary faces.
void expect_conforming(const Mesh& mesh, int n) {
  EXPECT_NEAR(volume(tets_of(mesh), mesh.nodes), n * n * n, 1e-12);
  EXPECT_EQ(boundary_faces(mesh).size(), static_cast<std::size_t>(12 * n * n));
}

TEST(SplitCells, NeighboursMatchWhateverTheNumbersOfNodes) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const LoadedMesh loaded = build_mesh(Blocks(3, seed, false).take(), FileCells::split);
    expect_conforming(loaded.mesh, 3);
    EXPECT_EQ(loaded.mesh.surfaces.at("top").size(), 18u);
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_EQ(loaded.warnings[0],
              fmt::format("blocks.msh: 27 hexahedra are split into {} tetrahedra", loaded.mesh.cells.size()));
  }
}

TEST(SplitCells, HexahedraWedgesAndPyramidsMatch) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const LoadedMesh loaded = build_mesh(Blocks(3, seed, true).take());
    expect_conforming(loaded.mesh, 3);
    EXPECT_EQ(loaded.warnings[0],
              fmt::format("blocks.msh: 9 hexahedra, 18 wedges and 54 pyramids are split into {} tetrahedra",
                          loaded.mesh.cells.size()));
  }
}

TEST(SplitCells, ASplitMeshCanBeMadeQuadratic) {
  Mesh mesh = build_mesh(Blocks(2, 3, true).take()).mesh;
  make_quadratic(mesh);
  EXPECT_EQ(validate(mesh, {.source = "blocks"}), Warnings{});
  for (const CellShape shape : mesh.cells.shapes()) EXPECT_EQ(shape, CellShape::tet10);
}

// A cube in the region "first", a tet on it, and a pyramid beside the tet.
MeshDraft three_kinds() {
  MeshDraft draft;
  draft.files = {"mixed.msh"};
  draft.nodes_section = "$Nodes";
  draft.region_names = {"first", "second"};
  for (std::size_t k = 0; k < 8; ++k) draft.nodes.push_back({static_cast<std::int64_t>(k), {}, kSolids[2].corners[k]});
  draft.nodes.push_back({8, {}, {0.5, 0.5, 2}});
  draft.nodes.push_back({9, {}, {0.5, -1, 1.5}});
  draft.cells = {{.tag = 70, .kind = CellKind::hexahedron, .nodes = {0, 1, 2, 3, 4, 5, 6, 7}, .place = {12}},
                 {.tag = 71, .nodes = {4, 9, 5, 8}, .place = {13}, .region = 1},
                 {.tag = 72, .kind = CellKind::pyramid, .nodes = {4, 5, 6, 7, 8}, .place = {14}, .region = 1}};
  return draft;
}

TEST(SplitCells, TetsOfAnElementFollowEachOtherInTheOrderOfTheFile) {
  const LoadedMesh loaded = build_mesh(three_kinds());
  EXPECT_EQ(loaded.mesh.cell_of, (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 2, 2}));
  EXPECT_EQ(loaded.mesh.region_of, (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(tets_of(loaded.mesh)[6], (Tet{4, 9, 5, 8}));
  EXPECT_EQ(loaded.warnings, Warnings{"mixed.msh: 1 hexahedron and 1 pyramid are split into 8 tetrahedra"});
}

TEST(SplitCells, AMeshOfTetsSaysNothing) {
  MeshDraft draft = three_kinds();
  draft.cells = {draft.cells[1]};
  const LoadedMesh loaded = build_mesh(std::move(draft));
  EXPECT_TRUE(loaded.mesh.cell_of.empty());
  EXPECT_EQ(loaded.warnings.size(), 1u);  // of unused nodes
}

TEST(SplitCells, AnInvertedElementIsTurnedAndToldWithItsLine) {
  const std::size_t tets = build_mesh(three_kinds()).mesh.cells.size();
  MeshDraft draft = three_kinds();
  auto& nodes = draft.cells[0].nodes;
  for (std::size_t k = 0; k < 4; ++k) std::swap(nodes[k], nodes[k + 4]);
  const LoadedMesh loaded = build_mesh(draft);
  EXPECT_EQ(loaded.mesh.cells.size(), tets);
  for (const Tet& tet : tets_of(loaded.mesh)) EXPECT_GT(signed_volume6(loaded.mesh, tet), 0);
  EXPECT_CONTAINS(loaded.warnings.at(0),
                  "mixed.msh:12: 1 of 3 elements list their nodes in inverted order, the first is element 70; they "
                  "were reoriented");
}

TEST(SplitCells, AMeshOfInvertedElementsIsTurned) {
  MeshDraft draft = Blocks(2, 5, false).take();
  for (FileCell& cell : draft.cells)
    for (std::size_t k = 0; k < 4; ++k) std::swap(cell.nodes[k], cell.nodes[k + 4]);
  const LoadedMesh loaded = build_mesh(std::move(draft), FileCells::split);
  expect_conforming(loaded.mesh, 2);
  EXPECT_CONTAINS(loaded.warnings.at(0), "all 8 elements list their nodes in inverted order");
}

TEST(SplitCells, RepeatedAndMissingNodesAreRefusedWithTheLine) {
  MeshDraft draft = three_kinds();
  draft.cells[0].nodes[2] = 0;
  EXPECT_CONTAINS(refusal_of([&] { build_mesh(draft); }), "mixed.msh:12: element 70: a hexahedron with repeated nodes");
  draft.cells[0].nodes[2] = 99;
  EXPECT_CONTAINS(refusal_of([&] { build_mesh(draft); }), "mixed.msh:12: element 70: node 99 is not defined in $Nodes");
}

TEST(SplitCells, LinearOnesBesideQuadraticTetsAreRefused) {
  MeshDraft draft = three_kinds();
  draft.cells[1].midsides = {0, 1, 2, 3, 4, 5};
  EXPECT_CONTAINS(refusal_of([&] { build_mesh(draft); }),
                  "mixed.msh:13: element 71 is quadratic, earlier ones are not; all must be of one order");
}

// Quadratic elements represent a map of degree 2 exactly, and so do the tets they are split into.
TEST(SplitCells, NodesWithinFacesAndHexahedraAreWhereTheElementHasThem) {
  const auto place = [](const Vec3& x) -> Vec3 {
    return {x[0] + 0.1 * x[1] * x[1] + 0.05 * x[0] * x[2], x[1] - 0.1 * x[0] * x[2], x[2] + 0.08 * x[0] * x[1]};
  };
  MeshDraft draft;
  draft.files = {"one.msh"};
  draft.region_names = {"body"};
  std::vector<Vec3> rest;
  const auto add = [&](const Vec3& x) {
    rest.push_back(x);
    draft.nodes.push_back({static_cast<std::int64_t>(rest.size() - 1), {}, place(x)});
    return static_cast<std::int64_t>(rest.size() - 1);
  };
  FileCell cell{.tag = 1, .kind = CellKind::hexahedron};
  const std::array<int, 4> around_x{0, 1, 1, 0}, around_y{0, 0, 1, 1};
  for (std::size_t k = 0; k < 8; ++k) cell.nodes[k] = add(Vec3(around_x[k % 4], around_y[k % 4], k < 4 ? 0 : 1));
  for (const auto& [a, b] : edges_of(CellKind::hexahedron))
    cell.edges.push_back({cell.nodes[a], cell.nodes[b], add((rest[a] + rest[b]) / 2)});
  draft.cells.push_back(cell);
  for (std::size_t n = 0; n < rest.size(); ++n)  // one whole face, and three edges of another
    if (rest[n][2] == 0) draft.node_sets["bottom"].push_back({static_cast<std::int64_t>(n), {}});
  for (const std::int64_t n : {0, 1, 5, 8}) draft.node_sets["some"].push_back({n, {}});
  const Mesh mesh = build_mesh(draft, FileCells::split).mesh;
  ASSERT_EQ(mesh.order(), 2);
  ASSERT_EQ(mesh.nodes.size(), 20u + 6 + (mesh.cells.size() == 6 ? 1 : 0));
  for (std::size_t t = 0; t < mesh.cells.size(); ++t)
    for (std::size_t e = 0; e < 6; ++e) {
      const auto at = [&](std::size_t k) { return rest[static_cast<std::size_t>(mesh.cells[t][kTetEdges[e][k]])]; };
      const Vec3 expected = place((at(0) + at(1)) / 2);
      EXPECT_LT((mesh.nodes[static_cast<std::size_t>(mesh.cells[t][4 + e])] - expected).norm(), 1e-14);
    }
  EXPECT_EQ(mesh.node_sets.at("bottom").size(), 9u);
  EXPECT_EQ(mesh.node_sets.at("some").size(), 4u);
}

// The face 4 5 6 7 is cut from 4 to 6.
TEST(SplitCells, ATetOnAQuadrilateralMustFitItsDiagonal) {
  MeshDraft draft = three_kinds();
  draft.cells.pop_back();
  draft.cells[1].nodes = {4, 5, 6, 8};
  EXPECT_EQ(build_mesh(draft).mesh.cells.size(), 7u);
  draft.cells[1].nodes = {4, 5, 7, 8};
  EXPECT_CONTAINS(
      refusal_of([&] { build_mesh(draft); }),
      "mixed.msh:13: element 71: one of its triangles lies on a quadrilateral of element 70 (mixed.msh:12), "
      "which is divided along the other diagonal, from node 4 to 6; mesh with pyramids between them");
  draft.cells[0].nodes[6] = 7;  // a collapsed face is no quadrilateral
  EXPECT_EQ(build_mesh(draft).mesh.cells.size(), 5u);
}

TEST(SplitCells, AQuadrilateralThatIsNoFaceIsRefusedWithItsLine) {
  MeshDraft draft = three_kinds();
  draft.surfaces["side"] = {{.tag = 5, .nodes = {0, 1, 5, 4}, .sides = 4, .place = {20}},
                            {.tag = 6, .nodes = {1, 3, 7, 5}, .sides = 4, .place = {21}}};
  EXPECT_CONTAINS(refusal_of([&] { build_mesh(draft); }), "mixed.msh:21: element 6: surface \"side\": not a face");
}

}  // namespace
}  // namespace orthodyn::split_cells_test
