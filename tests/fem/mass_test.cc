// The mass matrices against integrals over the box.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::mass_test {
namespace {

constexpr double kDensity = 3, kVolume = 2 * 1 * 0.5;

class AnyMass : public testing::TestWithParam<std::string> {
 protected:
  BuiltTestScene box(const std::string& clamps = "[]", const std::string& elasticity = "{}") const {
    return BuiltTestScene(fmt::format(R"(
mesh: {{type: box, size: [2, 1, 0.5], cells: [3, 2, 2], split: six, order: 1}}
materials: {{m: {}}}
mass: {}
clamps: {}
elasticity: {}
time: {{end: 1}}
)",
                                      fibre_material(10, kDensity), GetParam(), clamps, elasticity));
  }
};
INSTANTIATE_TEST_SUITE_P(Kinds, AnyMass, testing::Values("lumped", "consistent"),
                         [](const auto& tested) { return tested.param; });

TEST_P(AnyMass, SumsToDensityTimesVolume) {
  const auto s = box();
  EXPECT_NEAR(s.model().parts().mass->total(), kDensity * kVolume, 64 * kEps * kDensity);
  for (int k = 0; k < 3; ++k) {
    const Vector e = s.dofs([&](const Vec3&) { return Vec3(Vec3::Unit(k)); });
    Vector Me(s.size());
    s.model().multiply_mass(e, Me);
    EXPECT_NEAR(e.dot(Me), kDensity * kVolume, 64 * kEps * kDensity);
  }
}

TEST_P(AnyMass, IsSymmetricPositiveDefinite) {
  const auto s = box();
  EXPECT_GT(symmetric_eigenvalues(s.mass())[0], 0);
}

TEST_P(AnyMass, SolvingInvertsMultiplying) {
  Random random(121);
  for (const char* clamps : {"[]", "[{surface: x0}, {nearest: [2, 1, 0.5], components: [y]}]"}) {
    const auto s = box(clamps);
    const Vector x = random_dofs(random, s.size(), 1);
    Vector y(s.size());
    s.model().multiply_mass(x, y);
    s.model().solve_mass(y);
    EXPECT_LE((y - x).norm(), 1e-13 * x.norm());
    EXPECT_LE((s.mass() * x -
               [&] {
                 Vector z(s.size());
                 s.model().multiply_mass(x, z);
                 return z;
               }())
                  .norm(),
              1e-14 * x.norm());
  }
}

// The consistent mass on a general pattern, as an unsymmetric tangent needs it.
TEST_P(AnyMass, OnAGeneralPatternIsTheSameMatrix) {
  const auto s = box(), general = box("[]", "{corotation: warped, warped_tangent: unsymmetric}");
  ASSERT_FALSE(general.model().pattern().symmetric);
  EXPECT_LE((s.mass() - general.mass()).cwiseAbs().maxCoeff(), 16 * kEps);
  Random random(122);
  const Vector x = random_dofs(random, s.size(), 1);
  Vector y(s.size());
  general.model().multiply_mass(x, y);
  general.model().solve_mass(y);
  EXPECT_LE((y - x).norm(), 1e-13 * x.norm());
}

TEST_P(AnyMass, ClampedCoordinatesAreLeftOutOfIt) {
  const auto free = box(), held = box("[{surface: x0}]");
  const Eigen::MatrixXd M = free.mass();
  const auto& dofs = *held.model().parts().dofs;
  std::vector<Eigen::Index> kept;
  for (int i = 0; i < dofs.num_nodes(); ++i)
    for (int k = 0; k < 3; ++k)
      if (dofs.node(i)[static_cast<std::size_t>(k)] >= 0) kept.push_back(3 * i + k);
  EXPECT_LE((M(kept, kept) - held.mass()).cwiseAbs().maxCoeff(), 16 * kEps);
  EXPECT_NEAR(held.model().parts().mass->total(), kDensity * kVolume, 64 * kEps * kDensity);
}

BuiltTestScene box_with(const std::string& mass) {
  return BuiltTestScene(
      fmt::format("{{mesh: {{type: box, size: [2, 1, 0.5], cells: [3, 2, 2], order: 1}}, materials: {{m: {}}}, mass: "
                  "{}, time: {{end: 1}}}}",
                  fibre_material(10, kDensity), mass));
}

TEST(ConsistentMass, HasTheLumpedOneAsItsRowSums) {
  const Eigen::MatrixXd consistent = box_with("consistent").mass(), lumped = box_with("lumped").mass();
  EXPECT_TRUE(lumped.isDiagonal());
  EXPECT_LE((consistent.rowwise().sum() - lumped.diagonal()).cwiseAbs().maxCoeff(), 16 * kEps);
}

// Velocities linear in space are represented exactly: T = rho / 2 integral of |w x X|^2.
TEST(ConsistentMass, GivesTheKineticEnergyOfARigidSpinExactly) {
  const auto s = box_with("consistent");
  const double w = 1.7;
  const Vector v = s.dofs([&](const Vec3& X) { return Vec3(w * Vec3::UnitZ().cross(X - Vec3(1, 0.5, 0.25))); });
  const double inertia = kDensity * kVolume * (4.0 + 1.0) / 12;
  EXPECT_NEAR(s.scalar("energy.kinetic", s.zero(), v), 0.5 * inertia * w * w, 1e-13);
  const auto L = s.model().evaluate("momentum.angular", {0, s.zero(), v});
  EXPECT_NEAR(L[2], inertia * w, 1e-13);
}

}  // namespace
}  // namespace orthodyn::mass_test
