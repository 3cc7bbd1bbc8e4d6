// Loads and damping.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "lib/core/symmetric_eigen.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::loads_test {
namespace {

BuiltTestScene box(const std::string& rest) {
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: box, size: [2, 1, 0.5], cells: [3, 2, 2], origin: [1, 2, 3]}}
materials: {{m: {}}}
regions: {{body: {{material: m, axes: {}}}}}
time: {{end: 10}}
{})", fibre_material(10, 3), kTurnedAxes, rest));
}

Vec3 total(const NodalVector& f) { return f.rowwise().sum(); }
Vec3 moment(const NodalVector& f, const NodalVector& x) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < f.cols(); ++i) sum += x.col(i).cross(f.col(i));
  return sum;
}

TEST(Traction, ExertsTractionTimesAreaAtTheCentreOfTheSurface) {
  const Vec3 t(2, -3, 5);
  struct Side { const char* name; double area; Vec3 center; };
  for (const auto& side :
       {Side{"x1", 0.5, {3, 2.5, 3.25}}, Side{"y0", 1, {2, 2, 3.25}}, Side{"z1", 2, {2, 2.5, 3.5}}}) {
    const auto s = box(fmt::format("loads: [{{surface: {}, traction: [2, -3, 5]}}]", side.name));
    const NodalVector f = s.nodal(s.force(s.zero()));
    EXPECT_LE((total(f) - side.area * t).norm(), 64 * kEps * t.norm()) << side.name;
    EXPECT_LE((moment(f, s.positions(s.zero())) - side.center.cross(side.area * t)).norm(), 512 * kEps * t.norm())
        << side.name;
  }
}

TEST(Traction, IsDeadItFollowsNoMotion) {
  Random random(131);
  const auto s = box("loads: [{surface: x1, traction: [2, -3, 5]}]"), unloaded = box("");
  const Vector q = random_dofs(random, s.size(), 0.1);
  EXPECT_LE((s.force(q) - unloaded.force(q) - s.force(s.zero())).norm(), 1e-13 * s.force(q).norm());
}

TEST(Traction, GivenAsATotalForceIsThatForceOverTheArea) {
  const auto a = box("loads: [{surface: z1, force: [2, -3, 5]}]"),
             b = box("loads: [{surface: z1, traction: [1, -1.5, 2.5]}]");
  EXPECT_LE((a.force(a.zero()) - b.force(b.zero())).norm(), 64 * kEps);
}

TEST(Traction, HasThePowerOfItsForceOnTheVelocities) {
  Random random(132);
  const auto s = box("loads: [{surface: x1, traction: [2, -3, 5], factor: {type: constant, value: 1.5}}]");
  const Vector v = random_dofs(random, s.size(), 1);
  EXPECT_NEAR(s.scalar("power.loads", s.zero(), v), s.force(s.zero()).dot(v), 64 * kEps * v.norm());
}

TEST(Gravity, ExertsMassTimesAccelerationAtTheCentreOfMass) {
  const auto s = box("gravity: [1, -2, -9]");
  const Vec3 g(1, -2, -9);
  const double mass = 3 * 2 * 1 * 0.5;
  const NodalVector f = s.nodal(s.force(s.zero()));
  EXPECT_LE((total(f) - mass * g).norm(), 1e-13 * mass * g.norm());
  // With five tets a cell nodal masses alternate; the box of 3 x 2 x 2 cells is symmetric but along x.
  EXPECT_LE(std::abs(moment(f, s.positions(s.zero()))[0] - Vec3(2, 2.5, 3.25).cross(mass * g)[0]),
            1e-12 * mass * g.norm());
}

TEST(Gravity, HasTheEnergyOfTheHeight) {
  const auto s = box("gravity: [0, 0, -9]");
  const Vector q = s.dofs([](const Vec3&) { return Vec3(5, 0, 2); });
  EXPECT_NEAR(s.scalar("energy.gravitational", q, s.zero()), 3 * 9 * 2, 1e-12);
}

TEST(Breakpoints, AreTheKinksOfAllLoadsWithinTheTimeSpanSortedOnce) {
  const auto s = box(R"(
loads:
  - {surface: x1, traction: [1, 0, 0], factor: {type: table, points: [[0, 0], [5, 1], [7, 0], [20, 1]]}}
  - {surface: y1, traction: [1, 0, 0], factor: {type: ramp, start: 2, end: 5}}
  - {surface: z1, traction: [1, 0, 0]}
)");
  EXPECT_EQ(s.model().breakpoints(0, 10), (std::vector<double>{2, 5, 7}));
  EXPECT_EQ(s.model().breakpoints(2, 7), (std::vector<double>{5}));
  EXPECT_TRUE(s.model().traits().time_dependent);
}

TEST(Damping, PowerIsThatOfItsForceAndNeverNegative) {
  Random random(133);
  for (const char* corotation : {"exact", "warped"}) {
    const auto s =
        box(fmt::format("damping: {{stiffness: 0.2, mass: 0.7}}\nelasticity: {{corotation: {}}}", corotation));
    for (const double amplitude : {0.02, 0.3, 1.0}) {  // the last with inverted elements
      const Vector q = random_dofs(random, s.size(), amplitude), v = random_dofs(random, s.size(), 1);
      const double power = s.scalar("power.dissipated", q, v);
      const Eigen::MatrixXd D = s.matrix({0, 1, 0}, q, v);
      EXPECT_GE(power, 0);
      EXPECT_NEAR(power, v.dot(D * v), 1e-12 * power) << corotation << " " << amplitude;
      EXPECT_NEAR(power, -(s.force(q, v) - s.force(q)).dot(v), 1e-12 * (power + s.force(q).norm() * v.norm()));
      EXPECT_GE(symmetric_eigenvalues(D)[0], -1e-13 * D.norm());
    }
  }
}

TEST(Damping, ByStiffnessIsFreeForRigidMotionOfADeformedBody) {
  Random random(134);
  const auto s = box("damping: {stiffness: 0.2}");
  const Vector q = random_dofs(random, s.size(), 0.1);
  const NodalVector x = s.positions(q);
  NodalVector v(3, x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) v.col(i) = Vec3(1, 2, 3) + Vec3(-1, 0.5, 2).cross(x.col(i));
  const Vector rigid = v.reshaped();
  const Vector drag = s.force(q, rigid) - s.force(q);
  EXPECT_LE(drag.norm(), 1e-13 * (s.matrix({0, 1, 0}, q, rigid).norm() * rigid.norm()));
}

TEST(Damping, ByMassIsAlphaTimesTwiceTheKineticEnergy) {
  Random random(135);
  const auto s = box("damping: {mass: 0.7}");
  const Vector v = random_dofs(random, s.size(), 1);
  const double kinetic = s.scalar("energy.kinetic", s.zero(), v);
  EXPECT_NEAR(s.scalar("power.dissipated", s.zero(), v), 2 * 0.7 * kinetic, 1e-13 * kinetic);
  EXPECT_FALSE(s.model().traits().damping_matrix);
}

}  // namespace
}  // namespace orthodyn::loads_test
