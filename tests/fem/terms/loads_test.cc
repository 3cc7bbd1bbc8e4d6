// Loads and damping.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "lib/core/symmetric_eigen.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::loads_test {
namespace {

BuiltTestScene box(const std::string& rest) {
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: box, size: [2, 1, 0.5], cells: [3, 2, 2], origin: [1, 2, 3], order: 1}}
materials: {{m: {}}}
regions: {{body: {{material: m, axes: {}}}}}
time: {{end: 10}}
{})",
                                    fibre_material(10, 3), kTurnedAxes, rest));
}

Vec3 total(const NodalVector& f) { return f.rowwise().sum(); }
Vec3 moment(const NodalVector& f, const NodalVector& x) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < f.cols(); ++i) sum += x.col(i).cross(f.col(i));
  return sum;
}

TEST(Traction, ExertsTractionTimesAreaAtTheCentreOfTheSurface) {
  const Vec3 t(2, -3, 5);
  struct Side {
    const char* name;
    double area;
    Vec3 center;
  };
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
  for (const char* traction : {"[2, -3, 5]", "[2*y, -3*x, 5 + z^2]"}) {
    const auto s = box(fmt::format("loads: [{{surface: x1, traction: {}}}]", traction)), unloaded = box("");
    const Vector q = random_dofs(random, s.size(), 0.1);
    EXPECT_LE((s.force(q) - unloaded.force(q) - s.force(s.zero())).norm(), 1e-13 * s.force(q).norm()) << traction;
    EXPECT_EQ(s.stiffness(q), unloaded.stiffness(q)) << traction;
  }
}

// The face x = 3 of the box is [2, 3] x [3, 3.5] in y and z.
double power_integral(double from, double to, int power) {
  return (std::pow(to, power + 1) - std::pow(from, power + 1)) / (power + 1);
}
double face_integral(int y, int z) { return power_integral(2, 3, y) * power_integral(3, 3.5, z); }

TEST(Traction, ByLinearFormulasHasTheirForceAndMoment) {
  const auto s = box("loads: [{surface: x1, traction: [\"2 - y + 3*z\", 4, x*z]}]");
  const NodalVector f = s.nodal(s.force(s.zero()));
  const double t_x = 2 * face_integral(0, 0) - face_integral(1, 0) + 3 * face_integral(0, 1);
  const double y_t_x = 2 * face_integral(1, 0) - face_integral(2, 0) + 3 * face_integral(1, 1);
  const double z_t_x = 2 * face_integral(0, 1) - face_integral(1, 1) + 3 * face_integral(0, 2);
  const double t_y = 4 * face_integral(0, 0), z_t_y = 4 * face_integral(0, 1);
  const double t_z = 3 * face_integral(0, 1), y_t_z = 3 * face_integral(1, 1);
  EXPECT_LE((total(f) - Vec3(t_x, t_y, t_z)).norm(), 256 * kEps * total(f).norm());
  const Vec3 m = moment(f, s.positions(s.zero()));
  EXPECT_LE((m - Vec3(y_t_z - z_t_y, z_t_x - 3 * t_z, 3 * t_y - y_t_x)).norm(), 1024 * kEps * m.norm());
}

TEST(Traction, ByAFormulaOfDegreeFourIsIntegratedExactly) {
  for (const auto& [formula, y, z] : {std::tuple{"y^2", 2, 0}, {"y*z", 1, 1}, {"y^4", 4, 0}, {"y^2*z^2", 2, 2}}) {
    const auto s = box(fmt::format("loads: [{{surface: x1, traction: [\"{}\", 0, 0]}}]", formula));
    const NodalVector f = s.nodal(s.force(s.zero())), x = s.positions(s.zero());
    EXPECT_NEAR(f.row(0).sum(), face_integral(y, z), 1e-13 * face_integral(y, z)) << formula;
    EXPECT_NEAR(f.row(0).dot(x.row(1)), face_integral(y + 1, z), 1e-13 * face_integral(y + 1, z)) << formula;
    EXPECT_NEAR(f.row(0).dot(x.row(2)), face_integral(y, z + 1), 1e-13 * face_integral(y, z + 1)) << formula;
  }
  // Not one of degree six.
  const auto s = box("loads: [{surface: x1, traction: [y^6, 0, 0]}]");
  const double sum = s.force(s.zero()).sum();
  EXPECT_GT(std::abs(sum - face_integral(6, 0)), 1e-10 * sum);
}

TEST(Traction, TakesUnitsAndFormulasSideBySide) {
  const auto a = box("loads: [{surface: x1, traction: [2 kPa, -3 Pa, \"1e3*0.005\"]}]"),
             b = box("loads: [{surface: x1, traction: [2000, -3, 5]}]");
  EXPECT_LE((a.force(a.zero()) - b.force(b.zero())).norm(), 64 * kEps * b.force(b.zero()).norm());
}

TEST(Traction, ByAFormulaKeepsItsPeak) {
  const auto s = box("loads: [{surface: x1, traction: [y, 0, 0], factor: {type: sine, frequency: 1, amplitude: 3}}]");
  const NodalVector still = NodalVector::Zero(3, s.model().parts().rest->cols());
  NodalVector peak = still;
  s.model().parts().loads.at(0)->add_peak_force({0, *s.model().parts().rest, still, still}, 10, peak);
  EXPECT_NEAR(peak.row(0).sum(), 3 * face_integral(1, 0), 1e-12);
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
