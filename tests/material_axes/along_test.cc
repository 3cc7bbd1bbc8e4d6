// Axes along a curve through points.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "lib/material_axes/curve.h"
#include "tests/material_axes/axes_of.h"

namespace orthodyn::along_test {
namespace {

constexpr double kPi = std::numbers::pi;

// `count` points of a quarter circle of radius 1 about the origin, from x to y.
std::vector<Vec3> quarter_circle(int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double a = 0.5 * kPi * i / (count - 1);
    points.emplace_back(std::cos(a), std::sin(a), 0);
  }
  return points;
}

std::string along(const std::vector<Vec3>& points, const std::string& more = "") {
  return "{type: along, points: " + Value<std::vector<Vec3>>::yaml(points) + more + "}";
}

TEST(Curve, GoesThroughItsPoints) {
  Random random(41);
  std::vector<Vec3> points;
  for (int i = 0; i < 6; ++i) points.push_back(random.vector());
  const Curve curve(points);
  for (const Vec3& p : points) EXPECT_LE((curve.nearest(p).point - p).norm(), 1e-12);
}

TEST(Curve, ThroughTwoPointsIsStraight) {
  const Vec3 a(1, 2, 3), b(2, 2, 5);
  const Curve curve({a, b});
  EXPECT_NEAR(curve.length(), (b - a).norm(), 1e-14);
  for (const double t : {0.0, 0.3, 0.9}) {
    const auto foot = curve.nearest(a + t * (b - a) + Vec3(0.4, 0, -0.2));  // off it at a right angle
    EXPECT_LE((foot.point - (a + t * (b - a))).norm(), 1e-12);
    EXPECT_LE((foot.tangent - (b - a).normalized()).norm(), 1e-14);
  }
}

TEST(Curve, ThroughPointsOfACircleHasItsTangentsToThirdOrder) {
  const auto error = [](int count) {
    double worst = 0;
    const Curve curve(quarter_circle(count));
    for (int k = 10; k <= 20; ++k) {  // away from the ends, where the order is lower
      const double a = kPi * k / 60;
      const Vec3 tangent = curve.nearest(1.1 * Vec3(std::cos(a), std::sin(a), 0)).tangent;
      worst = std::max(worst, (tangent - Vec3(-std::sin(a), std::cos(a), 0)).norm());
    }
    return worst;
  };
  EXPECT_LE(error(9), 2e-3);
  EXPECT_GE(error(9) / error(17), 3.5);
}

TEST(Curve, HasItsFootWhereTheArmIsNormalToIt) {
  Random random(42);
  const Curve curve({{0, 0, 0}, {1, 0.3, 0}, {2, 0, 0.4}, {3, -0.2, 0.1}});
  for (int sample = 0; sample < 50; ++sample) {
    const Vec3 x = Vec3(0.5, 0, 0) + random.between(0, 2) * Vec3::UnitX() + 0.2 * random.vector();
    const auto foot = curve.nearest(x);
    EXPECT_LE(std::abs((x - foot.point).dot(foot.tangent)), 1e-10);
  }
}

// Compared with all points of a fine polygon.
TEST(Curve, HasNoNearerPointThanTheFoot) {
  Random random(43);
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back(random.vector());
  const Curve curve(points);
  std::vector<Vec3> on_it;
  for (const Vec3& x : points) on_it.push_back(x);
  for (int sample = 0; sample < 400; ++sample) on_it.push_back(curve.nearest(1.5 * random.vector()).point);
  for (int sample = 0; sample < 100; ++sample) {
    const Vec3 x = 1.2 * random.vector();
    const double distance = (curve.nearest(x).point - x).norm();
    for (const Vec3& p : on_it) EXPECT_LE(distance, (p - x).norm() + 1e-3);
  }
}

TEST(Curve, CarriesItsNormalWithoutATwist) {
  // Along a plane curve, the angle to the normal of the plane is constant.
  const Curve flat(quarter_circle(9), Vec3(1, 0, 1));
  for (const double a : {0.1, 0.7, 1.5}) {
    const Vec3 radial(std::cos(a), std::sin(a), 0), normal = flat.nearest(radial).normal;
    // Interpolation between samples at a distance of h = pi / 256 has an error of h^2 / 8.
    EXPECT_NEAR(normal.dot(Vec3(0, 0, 1)), std::sqrt(0.5), 2e-5);
    EXPECT_NEAR(normal.dot(radial), std::sqrt(0.5), 1e-3);
  }
}

TEST(AxesAlong, AStraightLineAreThoseOfACylinder) {
  Random random(44);
  const Vec3 a(0.1, -0.2, 0), b(0.4, 0.1, 2);
  const auto cylinder = fmt::format("{{type: cylindrical, point: {}, axis: {}, order: TRL, spiral: 0.2 rad}}",
                                    yaml_of(a), yaml_of(Vec3(b - a)));
  const auto line = along({a, 0.3 * b + 0.7 * a, b}, ", order: TRL, spiral: 0.2 rad");
  for (int sample = 0; sample < 50; ++sample) {
    const Vec3 x = a + random.between(0.1, 0.9) * (b - a) + 0.2 * random.vector();
    EXPECT_LE((axes_at(line, x) - axes_at(cylinder, x)).norm(), 1e-9);
  }
}

TEST(AxesAlong, AreRotationsEverywhere) {
  Random random(45);
  const auto bent = along({{0, 0, 0}, {1, 0.5, 0}, {1.5, 0, 1}, {3, -0.2, 0.1}}, ", across: carried");
  const auto radial = along({{0, 0, 0}, {1, 0.5, 0}, {1.5, 0, 1}, {3, -0.2, 0.1}});
  for (int sample = 0; sample < 100; ++sample) {
    const Vec3 x = 3 * random.vector();
    EXPECT_LE(improper(axes_at(bent, x)), 1e-13);
    EXPECT_LE(improper(axes_at(radial, x)), 1e-13);
  }
}

TEST(AxesAlong, OnTheCurveTakeTheCarriedNormal) {
  const auto text = along({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, ", start_normal: [0, 3, 3]");
  EXPECT_LE((axes_at(text, {0.5, 0, 0}).col(1) - Vec3(0, 1, 1).normalized()).norm(), 1e-12);
  EXPECT_LE((axes_at(text, {0.5, 0, 0.1}).col(1) - Vec3(0, 0, 1)).norm(), 1e-12);
}

TEST(AxesAlong, BeyondAnEndAreThoseOfTheEnd) {
  const auto text = along({{0, 0, 0}, {1, 0, 0}});
  EXPECT_LE((axes_at(text, {5, 0.1, 0}) - Mat3::Identity()).norm(), 1e-12);
  EXPECT_LE((axes_at(text, {5, 0, 0}).col(0) - Vec3(1, 0, 0)).norm(), 1e-12);
}

TEST(AxesAlong, AreRefusedWithoutACurve) {
  EXPECT_TRUE(holds(axes_refusal("{type: along}"), "exactly one of points, file"));
  EXPECT_TRUE(holds(axes_refusal(along({{0, 0, 0}})), "axes.points: found 1 point"));
  EXPECT_TRUE(holds(axes_refusal("{type: along, points: []}"), "at least two"));
  EXPECT_TRUE(holds(axes_refusal(along({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}})), "points 1 and 2 coincide"));
  EXPECT_TRUE(holds(axes_refusal(along({{1, 0, 0}, {1, 0, 0}})), "points 0 and 1"));
  const auto text = along({{0, 0, 0}, {1, 0, 0}}, ", start_normal: [2, 0, 0]");
  EXPECT_TRUE(holds(refusal([&] { axes_at(text); }), "start_normal is zero or parallel to the curve's start"));
}

class AxesFromFiles : public testing::Test {
 protected:
  std::string write(const std::string& content) {
    const auto path = std::filesystem::path(testing::TempDir()) /
                      fmt::format("{}.csv", testing::UnitTest::GetInstance()->current_test_info()->name());
    std::ofstream(path) << content;
    return path.string();
  }
  static Mat3 at(const std::string& path, int element, std::size_t mesh_size, const std::string& more = "",
                 Warnings* notes = nullptr) {
    Mesh mesh;
    mesh.cells = Cells(std::vector<Tet>(mesh_size));
    const auto source = axes_source("{type: file, file: " + path + more + "}");
    Warnings ignored;
    return source->field(mesh, notes ? *notes : ignored)(Vec3::Zero(), element);
  }
  static std::string refused(const std::string& path, std::size_t mesh_size = 2, const std::string& more = "") {
    return refusal([&] { at(path, 0, mesh_size, more); });
  }
};

TEST_F(AxesFromFiles, CurvesAreThoseOfTheirPoints) {
  const auto path = write("# a bend\nz,x,y\n0,0,0\r\n\n0,1,0.5\n1,1.5,0\n");
  const Vec3 x(0.7, 0.1, 0.2);
  EXPECT_EQ(axes_at("{type: along, file: " + path + "}", x), axes_at(along({{0, 0, 0}, {1, 0.5, 0}, {1.5, 0, 1}}), x));
}

TEST_F(AxesFromFiles, CurvesWithADoublePointAreRefused) {
  const auto path = write("x,y,z\n0,0,0\n0,0,0\n");
  EXPECT_TRUE(holds(refusal([&] { axes_at("{type: along, file: " + path + "}"); }), "points 0 and 1"));
}

TEST_F(AxesFromFiles, RowsAreThoseOfTheElementsInOrder) {
  const auto path = write("a1x,a1y,a1z,a2x,a2y,a2z\n1,0,0,0,1,0\n0,0,2,0,3,0\n");
  EXPECT_EQ(at(path, 0, 2), Mat3(Mat3::Identity()));
  EXPECT_LE((at(path, 1, 2) - (Mat3() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished()).norm(), 1e-15);
}

TEST_F(AxesFromFiles, RowsMayNameTheirElement) {
  const auto path = write("element,a1x,a1y,a1z,a2x,a2y,a2z\n7,0,0,1,0,1,0\n3,1,0,0,0,1,0\n");
  EXPECT_EQ(at(path, 3, 9), Mat3(Mat3::Identity()));
  EXPECT_TRUE(holds(refusal([&] { at(path, 4, 9); }), "no row for element 4"));
  EXPECT_TRUE(holds(refused(path, 7), ".csv:2: element 7 does not exist; the mesh has 0 to 6"));
}

TEST_F(AxesFromFiles, RowsTwiceForAnElementAreRefused) {
  EXPECT_TRUE(holds(refused(write("element,a1x,a1y,a1z,a2x,a2y,a2z\n0,1,0,0,0,1,0\n0,1,0,0,0,1,0\n")),
                    ".csv:3: element 0 already has a row"));
}

TEST_F(AxesFromFiles, RowsMoreOrFewerThanElementsAreRefused) {
  EXPECT_TRUE(holds(refused(write("a1x,a1y,a1z,a2x,a2y,a2z\n1,0,0,0,1,0\n")), "1 rows for a mesh of 2 elements"));
}

TEST_F(AxesFromFiles, RowsThatAreNotOrthogonalAreRefusedOrRepaired) {
  const auto path = write("a1x,a1y,a1z,a2x,a2y,a2z\n1,0,0,0,1,0\n1,0,0,1,1,0\n");
  EXPECT_TRUE(holds(refused(path), ".csv:3: axes 1 and 2 enclose 45 degrees"));
  Warnings notes;
  const Mat3 Q = at(path, 1, 2, ", repair: orthonormalise", &notes);
  EXPECT_LE(improper(Q), 1e-14);
  EXPECT_NEAR(std::atan2(Q(1, 0), Q(0, 0)), -kPi / 8, 1e-14);  // half of what is missing to a right angle
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(holds(notes[0], "1 of 2 axes were repaired"));
}

TEST_F(AxesFromFiles, RowsWithThreeAxesAreCheckedForHandedness) {
  const auto path = write("a1x,a1y,a1z,a2x,a2y,a2z,a3x,a3y,a3z\n1,0,0,0,1,0,0,0,1\n1,0,0,0,1,0,0,0,-1\n");
  EXPECT_TRUE(holds(refused(path), ".csv:3: axis 3 points against 1 x 2"));
}

TEST_F(AxesFromFiles, BadTextIsRefusedWithItsLine) {
  const std::string header = "a1x,a1y,a1z,a2x,a2y,a2z\n";
  EXPECT_TRUE(holds(refused(write(header + "1,0,0,0,1\n")), ".csv:2: found 5 entries where 6 columns are named"));
  EXPECT_TRUE(holds(refused(write(header + "1,0,0,0,1,x\n")), "column a2z: expected a finite number, found 'x'"));
  EXPECT_TRUE(holds(refused(write(header + "1,0,0,0,1,nan\n")), "found 'nan'"));
  EXPECT_TRUE(holds(refused(write(header + "0,0,0,0,1,0\n1,0,0,0,1,0\n")), ".csv:2: the three directions lie"));
  EXPECT_TRUE(holds(refused(write(header)), "no rows"));
  EXPECT_TRUE(holds(refused(write("")), "no rows"));
  EXPECT_TRUE(holds(refused(write("1,0,0,0,1,0\n")), ".csv:1: found the number 1 where a column name belongs"));
  EXPECT_TRUE(holds(refused(write("a1x,a1x\n")), "column 'a1x' occurs twice"));
  EXPECT_TRUE(holds(refused(write("a1x,b\n")), "unknown column 'b'"));
  EXPECT_TRUE(holds(refused(write("a1x,a1y,a1z,a2x,a2y\n")), "column 'a2z' is missing"));
  EXPECT_TRUE(holds(refused(write("a1x,a1y,a1z,a2x,a2y,a2z,a3x\n1,0,0,0,1,0,0\n")), "axis 3 needs all of"));
  EXPECT_TRUE(holds(refused(write("element,a1x,a1y,a1z,a2x,a2y,a2z\n0.5,1,0,0,0,1,0\n")),
                    "expected a whole number from 0, found 0.5"));
  EXPECT_TRUE(holds(refused("/nowhere.csv"), "no such file: /nowhere.csv"));
  const auto unknown = std::filesystem::path(testing::TempDir()) / "axes.txt";
  std::ofstream(unknown) << header;
  EXPECT_TRUE(holds(refused(unknown.string()), "axes cannot be read from a file of type '.txt'"));
}

}  // namespace
}  // namespace orthodyn::along_test
