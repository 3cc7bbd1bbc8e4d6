#include "lib/mesh/cylinder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tests/mesh/refusal.h"
#include "tests/mesh/tets.h"

namespace orthodyn::cylinder_test {
namespace {

constexpr double kPi = std::numbers::pi;

CylinderMesh cylinder_of(int around, double grading = 1) {
  return {.radius = 2, .length = 3, .cells = {.around = around, .through = 3, .along = 5, .grading = grading}};
}
TubeMesh tube_of(int around, double grading = 1) {
  return {{.radius = 2, .length = 3, .cells = {.around = around, .through = 3, .along = 5, .grading = grading}}, 1};
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) sum += cell_volume(mesh, e);
  return sum;
}

Vec3 area_vector(const Mesh& mesh, const FaceCorners& t) {
  const auto x = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(t[k])]; };
  return t.size() == 3 ? (x(1) - x(0)).cross(x(2) - x(0)) / 2 : (x(2) - x(0)).cross(x(3) - x(1)) / 2;
}

template <class Round>
Round with_hexahedra(Round round, int order = 1) {
  round.elements = RoundMesh::Elements::hexahedra;
  round.order = order;
  return round;
}

double area(const Mesh& mesh, const std::string& surface) {
  double sum = 0;
  for (const FaceCorners& t : mesh.surfaces.at(surface)) sum += area_vector(mesh, t).norm();
  return sum;
}

// A regular polygon of n corners on a circle of radius r.
double polygon_area(int n, double r) { return n * r * r * std::sin(2 * kPi / n) / 2; }
double polygon_length(int n, double r) { return 2 * n * r * std::sin(kPi / n); }

// The smallest radius-ratio quality 3 r_in / r_circ of the tets, 1 for a regular one.
double worst_quality(const Mesh& mesh) {
  double worst = 1;
  for (const Tet& tet : tets_of(mesh)) {
    const auto x = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(tet[k])]; };
    Mat3 edges;
    Vec3 squares;
    for (std::size_t k = 0; k < 3; ++k) {
      edges.row(static_cast<int>(k)) = x(k + 1) - x(0);
      squares[static_cast<int>(k)] = edges.row(static_cast<int>(k)).squaredNorm() / 2;
    }
    const double circumradius = edges.inverse().operator*(squares).norm();
    double surface = 0;
    for (const FaceCorners& f : {FaceCorners{tet[0], tet[1], tet[2]}, FaceCorners{tet[0], tet[1], tet[3]},
                                 FaceCorners{tet[0], tet[2], tet[3]}, FaceCorners{tet[1], tet[2], tet[3]}}) {
      surface += area_vector(mesh, f).norm();
    }
    worst = std::min(worst, 3 * (signed_volume6(mesh, tet) / 2 / surface) / circumradius);
  }
  return worst;
}

TEST(Cylinder, HasExactlyTheVolumeAndAreasOfItsPolygon) {
  for (const double grading : {1.0, 0.3, 4.0}) {
    const Mesh mesh = make_cylinder(cylinder_of(16, grading));
    EXPECT_NEAR(volume(mesh), 3 * polygon_area(16, 2), 1e-12);
    EXPECT_NEAR(area(mesh, "end0"), polygon_area(16, 2), 1e-12);
    EXPECT_NEAR(area(mesh, "end1"), polygon_area(16, 2), 1e-12);
    EXPECT_NEAR(area(mesh, "outer"), 3 * polygon_length(16, 2), 1e-12);
  }
}

TEST(Tube, HasExactlyTheVolumeAndAreasOfItsPolygons) {
  for (const double grading : {1.0, 0.3, 4.0}) {
    const Mesh mesh = make_tube(tube_of(10, grading));
    EXPECT_NEAR(volume(mesh), 3 * (polygon_area(10, 2) - polygon_area(10, 1)), 1e-12);
    EXPECT_NEAR(area(mesh, "inner"), 3 * polygon_length(10, 1), 1e-12);
    EXPECT_NEAR(area(mesh, "outer"), 3 * polygon_length(10, 2), 1e-12);
  }
}

// Quadratic hexahedra have the true surfaces up to the error of an interpolated circle, of order 4.
TEST(RoundHexahedra, HaveTheVolumeOfTheTrueBodyAtOrderTwo) {
  const auto error = [](int around) {
    return std::abs(volume(make_tube(with_hexahedra(tube_of(around), 2))) / (9 * kPi) - 1) +
           std::abs(volume(make_cylinder(with_hexahedra(cylinder_of(around), 2))) / (12 * kPi) - 1);
  };
  EXPECT_LT(error(16), 1e-3);
  const double order = std::log2(error(16) / error(32));
  EXPECT_GT(order, 3.5);
  EXPECT_LT(order, 4.5);
}

TEST(RoundHexahedra, HaveExactlyTheVolumeOfTheirPolygonAtOrderOne) {
  EXPECT_NEAR(volume(make_cylinder(with_hexahedra(cylinder_of(16)))), 3 * polygon_area(16, 2), 1e-12);
  EXPECT_NEAR(volume(make_tube(with_hexahedra(tube_of(10)))), 3 * (polygon_area(10, 2) - polygon_area(10, 1)), 1e-12);
}

TEST(Cylinder, ItsVolumeConvergesWithSecondOrder) {
  const auto error = [](int around) { return 12 * kPi - volume(make_cylinder(cylinder_of(around))); };
  const double order = std::log2(error(16) / error(32));
  EXPECT_GT(order, 1.9);
  EXPECT_LT(order, 2.1);
}

class RoundMeshes : public testing::TestWithParam<std::pair<const char*, Mesh>> {};

TEST_P(RoundMeshes, AreValid) {
  Mesh mesh = GetParam().second;
  EXPECT_TRUE(validate(mesh, {"generator"}).empty());
}

// Every boundary face is in exactly one surface, and the area vectors of a closed surface add to 0.
TEST_P(RoundMeshes, AreWatertight) {
  const Mesh& mesh = GetParam().second;
  std::size_t count = 0;
  Vec3 sum = Vec3::Zero();
  for (const auto& [name, faces] : mesh.surfaces) {
    count += faces.size();
    for (const FaceCorners& t : faces) sum += area_vector(mesh, t);
  }
  EXPECT_EQ(count, boundary_faces(mesh).size());
  EXPECT_LT(sum.norm(), 1e-12);
}

TEST_P(RoundMeshes, HaveNoSlivers) {
  if (GetParam().second.has_tets_only()) {
    EXPECT_GT(worst_quality(GetParam().second), 0.2);
  }
}

INSTANTIATE_TEST_SUITE_P(Generators, RoundMeshes,
                         testing::Values(std::pair{"cylinder8", make_cylinder(cylinder_of(8))},
                                         std::pair{"cylinder16", make_cylinder(cylinder_of(16))},
                                         std::pair{"cylinder24", make_cylinder(cylinder_of(24))},
                                         std::pair{"graded", make_cylinder(cylinder_of(16, 0.5))},
                                         std::pair{"tube12", make_tube(tube_of(12))},
                                         std::pair{"tube31", make_tube(tube_of(31))},
                                         std::pair{"graded_tube", make_tube(tube_of(16, 2))},
                                         std::pair{"hexahedra", make_cylinder(with_hexahedra(cylinder_of(16)))},
                                         std::pair{"hexahedra_of_tube", make_tube(with_hexahedra(tube_of(12)))}),
                         [](const auto& test) { return test.param.first; });

TEST(Tube, GradingIsTheRatioOfOutermostToInnermostRing) {
  const Mesh mesh = make_tube(tube_of(8, 4));
  std::vector<double> radii;
  for (int ring = 0; ring < 4; ++ring) radii.push_back(mesh.nodes[static_cast<std::size_t>(8 * ring)][0]);
  EXPECT_NEAR((radii[3] - radii[2]) / (radii[1] - radii[0]), 4, 1e-12);
  EXPECT_NEAR(radii[2] - radii[1], 2 * (radii[1] - radii[0]), 1e-12);
}

TEST(Cylinder, LiesAlongItsAxisFromItsOrigin) {
  CylinderMesh cylinder = cylinder_of(8);
  cylinder.origin = {1, 2, 3};
  cylinder.axis = {0, -5, 0};
  const Box box = bounding_box(make_cylinder(cylinder));
  EXPECT_NEAR(box.min[1], -1, 1e-12);
  EXPECT_NEAR(box.max[1], 2, 1e-12);
  EXPECT_NEAR(
      make_cylinder(cylinder).nodes[static_cast<std::size_t>(make_cylinder(cylinder).surfaces.at("end0")[0][0])][1], 2,
      1e-12);
}

// Includes axes that are (nearly) opposite to z.
TEST(Cylinder, TurnedToAnyAxisItIsTheSameBody) {
  const Mesh upright = make_cylinder(cylinder_of(8));
  for (const Vec3& axis :
       {Vec3(0, 0, -1), Vec3(1e-9, -2e-9, -1), Vec3(1e-200, 0, -3), Vec3(1, 2, -3), Vec3(0, 1e-12, 1)}) {
    CylinderMesh cylinder = cylinder_of(8);
    cylinder.axis = axis;
    const Mesh turned = make_cylinder(cylinder);
    for (std::size_t e = 0; e < turned.cells.size(); ++e) {
      EXPECT_NEAR(6 * cell_volume(turned, e), 6 * cell_volume(upright, e), 1e-13) << axis;
    }
    for (std::size_t n = 0; n < turned.nodes.size(); ++n) {
      EXPECT_NEAR(turned.nodes[n].norm(), upright.nodes[n].norm(), 1e-13) << axis;
      EXPECT_NEAR(turned.nodes[n].dot(axis.stableNormalized()), upright.nodes[n][2], 1e-13) << axis;
    }
  }
}

TEST(Cylinder, RefusesWhatMakesNoMesh) {
  EXPECT_CONTAINS(refusal_of([] { make_cylinder(cylinder_of(10)); }), "must be a multiple of 4, such as 12");
  EXPECT_CONTAINS(refusal_of([] { make_cylinder(cylinder_of(8, 0)); }), "grading 0; it must lie in");
  TubeMesh tube = tube_of(8);
  tube.inner_radius = 2;
  EXPECT_CONTAINS(refusal_of([&] { make_tube(tube); }), "the inner one must be the smaller");
  tube = tube_of(8);
  tube.axis.setZero();
  EXPECT_CONTAINS(refusal_of([&] { make_tube(tube); }), "the axis is zero");
}

}  // namespace
}  // namespace orthodyn::cylinder_test
