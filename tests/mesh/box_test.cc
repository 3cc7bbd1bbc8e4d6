#include "lib/mesh/box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "lib/core/errors.h"
#include "tests/mesh/tets.h"

namespace orthodyn::box_test {
namespace {

using Split = BoxMesh::Split;

// Odd and even counts, different sizes, away from zero.
BoxMesh some_box(Split split) {
  return {.size = {3, 1, 0.5}, .cells = {4, 3, 2}, .origin = {-1, 2, 10}, .split = split};
}

const Vec3& node(const Mesh& mesh, int n) { return mesh.nodes[static_cast<std::size_t>(n)]; }

// The area of a triangle as a vector along its normal.
Vec3 area_vector(const Mesh& mesh, const FaceCorners& t) {
  const Vec3& a = node(mesh, t[0]);
  return 0.5 * (node(mesh, t[1]) - a).cross(node(mesh, t[2]) - a);
}

double area(const Mesh& mesh, const std::vector<FaceCorners>& triangles) {
  return std::accumulate(triangles.begin(), triangles.end(), 0.0,
                         [&](double sum, const FaceCorners& t) { return sum + area_vector(mesh, t).norm(); });
}

// How many tets have the face, counted without the code under test.
std::map<std::set<int>, int> count_faces(const Mesh& mesh) {
  std::map<std::set<int>, int> count;
  for (const Tet& tet : tets_of(mesh)) {
    for (int left_out : tet) {
      std::set<int> face(tet.begin(), tet.end());
      face.erase(left_out);
      ++count[face];
    }
  }
  return count;
}

class MakeBox : public testing::TestWithParam<Split> {};
INSTANTIATE_TEST_SUITE_P(Splits, MakeBox, testing::Values(Split::five, Split::six),
                         [](const auto& tested) { return tested.param == Split::five ? "five" : "six"; });

TEST_P(MakeBox, EveryTetOfABoxHasPositiveVolume) {
  const Mesh mesh = make_box(some_box(GetParam()));
  for (const Tet& tet : tets_of(mesh)) EXPECT_GT(signed_volume6(mesh, tet), 0);
}

TEST_P(MakeBox, HasSoManyTetsPerCell) {
  const std::size_t per_cell = GetParam() == Split::five ? 5 : 6;
  EXPECT_EQ(make_box(some_box(GetParam())).cells.size(), per_cell * 4 * 3 * 2);
}

TEST_P(MakeBox, HasTheNodesOfAGrid) {
  const Mesh mesh = make_box(some_box(GetParam()));
  EXPECT_EQ(mesh.nodes.size(), 5u * 4u * 3u);
  EXPECT_EQ(mesh.nodes.front(), Vec3(-1, 2, 10));
  EXPECT_EQ(mesh.nodes.back(), Vec3(2, 3, 10.5));
}

TEST_P(MakeBox, TheVolumesSumToThatOfTheBox) {
  const Mesh mesh = make_box(some_box(GetParam()));
  double volume6 = 0;
  for (const Tet& tet : tets_of(mesh)) volume6 += signed_volume6(mesh, tet);
  EXPECT_NEAR(volume6 / 6, 3 * 1 * 0.5, 1e-13);
}

TEST_P(MakeBox, EveryFaceBelongsToOneOrTwoTets) {
  for (const auto& [face, tets] : count_faces(make_box(some_box(GetParam())))) EXPECT_LE(tets, 2);
}

TEST_P(MakeBox, TheFacesOfOneTetCoverTheBoxExactly) {
  const Mesh mesh = make_box(some_box(GetParam()));
  double total = 0;
  for (const auto& [face, tets] : count_faces(mesh)) {
    const std::vector<int> n(face.begin(), face.end());
    if (tets == 1) total += area_vector(mesh, {n[0], n[1], n[2]}).norm();
  }
  EXPECT_NEAR(total, 2 * (3 * 1 + 1 * 0.5 + 3 * 0.5), 1e-12);
}

TEST_P(MakeBox, TheSurfacesAreTheSixSides) {
  const Mesh mesh = make_box(some_box(GetParam()));
  std::vector<std::string> names;
  for (const auto& [name, triangles] : mesh.surfaces) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"x0", "x1", "y0", "y1", "z0", "z1"}));
}

TEST_P(MakeBox, EverySurfaceLiesInItsSideAndCoversIt) {
  const Mesh mesh = make_box(some_box(GetParam()));
  const std::map<std::string, double> place = {{"x0", -1}, {"x1", 2}, {"y0", 2}, {"y1", 3}, {"z0", 10}, {"z1", 10.5}};
  const double side_area[] = {1 * 0.5, 3 * 0.5, 3 * 1};
  for (const auto& [name, triangles] : mesh.surfaces) {
    const int axis = name[0] - 'x';
    EXPECT_NEAR(area(mesh, triangles), side_area[axis], 1e-13) << name;
    for (const FaceCorners& t : triangles) {
      for (int n : t) EXPECT_DOUBLE_EQ(node(mesh, n)[axis], place.at(name)) << name;
    }
  }
}

TEST_P(MakeBox, TheSurfacesPointOutward) {
  const Mesh mesh = make_box(some_box(GetParam()));
  for (const auto& [name, triangles] : mesh.surfaces) {
    const double outward = name[1] == '0' ? -1 : 1;
    for (const FaceCorners& t : triangles) {
      EXPECT_GT(outward * area_vector(mesh, t)[name[0] - 'x'], 0) << name;
    }
  }
}

TEST_P(MakeBox, EveryTetIsInTheRegionBody) {
  const Mesh mesh = make_box(some_box(GetParam()));
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"body"});
  EXPECT_EQ(mesh.region_of, std::vector<int>(mesh.cells.size(), 0));
}

TEST_P(MakeBox, IsValidAtAnyScale) {
  for (double scale : {1e-7, 1.0, 1e7}) {
    BoxMesh box = some_box(GetParam());
    box.size *= scale;
    box.origin *= scale;
    Mesh mesh = make_box(box);
    EXPECT_TRUE(validate(mesh, {"box"}).empty());
  }
}

TEST_P(MakeBox, ASingleCellHasTwoTrianglesPerSide) {
  const Mesh mesh = make_box({.split = GetParam()});
  for (const auto& [name, triangles] : mesh.surfaces) EXPECT_EQ(triangles.size(), 2u) << name;
}

// The tets as sets of grid places (in units of cells), mirrored along `axis` if that is not -1.
std::set<std::set<std::array<int, 3>>> grid_tets(const BoxMesh& box, int mirror) {
  std::set<std::set<std::array<int, 3>>> tets;
  const Mesh mesh = make_box(box);
  for (const Tet& tet : tets_of(mesh)) {
    std::set<std::array<int, 3>> corners;
    for (int n : tet) {
      std::array<int, 3> place{};
      for (int a = 0; a < 3; ++a) {
        const int cells = box.cells[static_cast<std::size_t>(a)];
        const int i = static_cast<int>(std::lround((node(mesh, n)[a] - box.origin[a]) / box.size[a] * cells));
        place[static_cast<std::size_t>(a)] = a == mirror ? cells - i : i;
      }
      corners.insert(place);
    }
    tets.insert(corners);
  }
  return tets;
}

TEST(MakeBoxSymmetry, FiveTetsInEvenCellsAreMirrorSymmetric) {
  const BoxMesh box{.size = {2, 1, 3}, .cells = {2, 4, 2}, .split = Split::five};
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(grid_tets(box, axis), grid_tets(box, -1)) << axis;
}

TEST(MakeBoxSymmetry, FiveTetsInOddCellsAreNot) {
  const BoxMesh box{.cells = {3, 2, 2}, .split = Split::five};
  EXPECT_NE(grid_tets(box, 0), grid_tets(box, -1));
  EXPECT_EQ(grid_tets(box, 1), grid_tets(box, -1));
}

std::string refusal(const BoxMesh& box) {
  try {
    make_box(box);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MakeBoxRefuses, NoCells) { EXPECT_EQ(refusal({.cells = {1, 0, 1}}), "0 cells along y; there must be at least 1"); }

TEST(MakeBoxRefuses, ASizeThatIsNotPositive) {
  EXPECT_EQ(refusal({.size = {1, 1, -2}}), "box size -2 m along z; it must be positive and finite");
  EXPECT_NE(refusal({.size = {0, 1, 1}}), "accepted");
}

TEST(MakeBoxRefuses, NumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal({.size = {nan, 1, 1}}), "accepted");
  EXPECT_NE(refusal({.size = {1, infinity, 1}}), "accepted");
  EXPECT_NE(refusal({.origin = {1, nan, 1}}), "accepted");
}

TEST(MakeBoxRefuses, MoreNodesThanAnIntCanCount) {
  const int max = std::numeric_limits<int>::max();
  EXPECT_NE(refusal({.cells = {2000, 2000, 2000}}).find("at most 2147483647"), std::string::npos);
  EXPECT_NE(refusal({.cells = {max, max, max}}).find("at most 2147483647"), std::string::npos);
}

TEST(Box, LayersHaveTheirHeights) {
  const Mesh mesh = make_box({.size = {1, 1, 0.6}, .cells = {1, 1, 3}, .origin = {0, 0, 2}, .layers = {1, 3, 2}});
  std::set<double> heights;
  for (const Vec3& x : mesh.nodes) heights.insert(x[2]);
  const std::vector<double> expected{2, 2.1, 2.4, 2.6};
  ASSERT_EQ(heights.size(), 4u);
  std::size_t k = 0;
  for (const double z : heights) EXPECT_NEAR(z, expected[k++], 1e-15);
  EXPECT_EQ(*heights.rbegin(), 2.6);  // the top is exact
}

TEST(Box, LayersAreAsManyAsCellsAlongZ) {
  EXPECT_THROW(make_box({.cells = {1, 1, 3}, .layers = {1, 2}}), ConfigError);
  EXPECT_THROW(make_box({.cells = {1, 1, 2}, .layers = {1, -1}}), ConfigError);
}

}  // namespace
}  // namespace orthodyn::box_test
