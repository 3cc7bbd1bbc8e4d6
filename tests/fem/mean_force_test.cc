// The force between two states: exact energy, no torque, second order.
#include <gtest/gtest.h>

#include "lib/core/errors.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::mean_force_test {
namespace {

std::string block(const std::string& material, const std::string& more = "") {
  return "mesh: {type: box, size: [1, 0.8, 0.6], cells: [2, 2, 1], order: 1}\nmaterials: {m: " + material +
         "}\nregions: {all: {material: m, axes: " + kTurnedAxes + "}}\ntime: {end: 1}\n" + more;
}

std::vector<std::string> materials() {
  return {"{type: isotropic, density: 1, young: 10, nu: 0.3}", fibre_material(10), fibre_material(1000),
          turned_fibre_material(30, Eigen::AngleAxisd(0.4, Vec3(1, -2, 1).normalized()).toRotationMatrix())};
}

// The rest shape turned by a large angle, strained smoothly and with some noise.
Vector state(const BuiltTestScene& s, double angle, double strain, Random& random) {
  const Mat3 R = Eigen::AngleAxisd(angle, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Mat3 stretch = Vec3(1 + strain, 1 - 0.5 * strain, 1).asDiagonal();
  return s.dofs([&](const Vec3& X) { return Vec3(R * stretch * X - X); }) + random_dofs(random, s.size(), 0.02);
}

struct Pair {
  Vector q0, q1;
};
Pair two_states(const BuiltTestScene& s) {
  Random random(5);
  const Vector q0 = state(s, 0.3, 0.1, random);
  return {q0, state(s, 0.9, -0.05, random)};
}

Vector mean_force(const BuiltTestScene& s, const Vector& q0, const Vector& q1) {
  Vector f(s.size());
  s.model().discrete_gradient()->mean_force(0, q0, 0.1, q1, s.zero(), f);
  return f;
}

TEST(MeanForce, DoesTheWorkThatTheEnergyLoses) {
  for (const auto& material : materials())
    for (const char* gravity : {"", "gravity: [0, 0, -2]"}) {
      const BuiltTestScene s(block(material, gravity));
      const auto [q0, q1] = two_states(s);
      const Vector f = mean_force(s, q0, q1);
      const double scale =
          std::abs(s.potential(q0)) + std::abs(s.potential(q1)) + (f.array() * (q1 - q0).array()).abs().sum();
      EXPECT_NEAR(f.dot(q1 - q0), s.potential(q0) - s.potential(q1), 1e-13 * scale) << material;
    }
}

// Also over a step so short that a quotient of energy differences would be round-off.
TEST(MeanForce, DoesTheWorkOfAShortStepToRoundOff) {
  const BuiltTestScene s(block(fibre_material(100)));
  Random random(7);
  const Vector q0 = state(s, 0.3, 0.1, random), direction = random_dofs(random, s.size(), 1);
  for (const double h : {1e-4, 1e-7, 1e-10}) {
    const Vector mean = mean_force(s, q0, q0 + h * direction), middle = s.force(q0 + 0.5 * h * direction);
    EXPECT_LE((mean - middle).norm(), (100 * h * h + 1e-13) * middle.norm()) << h;
  }
}

TEST(MeanForce, HasNoNetForceAndNoTorqueAboutTheMeanPositions) {
  for (const auto& material : materials()) {
    const BuiltTestScene s(block(material));
    const auto [q0, q1] = two_states(s);
    const NodalVector f = s.nodal(mean_force(s, q0, q1)), x = 0.5 * (s.positions(q0) + s.positions(q1));
    Vec3 torque = Vec3::Zero();
    double scale = 0;
    for (Eigen::Index i = 0; i < f.cols(); ++i) {
      torque += x.col(i).cross(f.col(i));
      scale += x.col(i).norm() * f.col(i).norm();
    }
    EXPECT_LE(torque.norm(), 1e-14 * scale) << material;
    EXPECT_LE(f.rowwise().sum().norm(), 1e-14 * f.colwise().norm().sum()) << material;
  }
}

// f(q - h d, q + h d) - f(q) falls as h^2.
TEST(MeanForce, IsOfSecondOrderAboutTheMiddle) {
  const BuiltTestScene s(block(fibre_material(30)));
  Random random(3);
  const Vector q = state(s, 0.5, 0.1, random), direction = random_dofs(random, s.size(), 0.1), exact = s.force(q);
  const auto error = [&](double h) { return (mean_force(s, q - h * direction, q + h * direction) - exact).norm(); };
  EXPECT_NEAR(std::log2(error(0.04) / error(0.02)), 2, 0.1);
  EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 2, 0.05);
}

TEST(MeanForce, OfSmallStrainIsThatOfTheMiddle) {
  const BuiltTestScene s(block(fibre_material(30), "elasticity: {kinematics: linear}\n"));
  const auto [q0, q1] = two_states(s);
  EXPECT_LE((mean_force(s, q0, q1) - s.force(0.5 * (q0 + q1))).norm(), 1e-13 * s.force(q0).norm());
}

TEST(MeanForce, IsRefusedForAnInvertedElementAsRecoverable) {
  const BuiltTestScene s(block(fibre_material(10)));
  const Vector mirrored = s.dofs([](const Vec3& X) { return Vec3(-2 * X[0], 0, 0); });
  EXPECT_THROW(mean_force(s, s.zero(), mirrored), RecoverableError);
}

TEST(MeanForce, DoesNotExistForTheWarpedForce) {
  const BuiltTestScene s(block(fibre_material(10), "elasticity: {corotation: warped}\n"));
  EXPECT_EQ(s.model().discrete_gradient(), nullptr);
}

}  // namespace
}  // namespace orthodyn::mean_force_test
