// Rigid motions, the near null space of K that iterative solvers use.
#include <gtest/gtest.h>

#include "tests/fem/built_scene.h"

namespace orthodyn::rigid_motions_test {
namespace {

BuiltTestScene body(const std::string& clamps) {
  return BuiltTestScene(R"(
mesh: {type: box, size: [2, 1, 0.5], cells: [2, 2, 1]}
materials: {m: )" + fibre_material(10) +
                        R"(}
)" + clamps + R"(
time: {end: 1}
)");
}

TEST(RigidMotions, OfAFreeBodyAreResistedByNothing) {
  const BuiltTestScene scene = body("");
  const Eigen::MatrixXd motions = scene.model().rigid_motions(scene.zero());
  ASSERT_EQ(motions.rows(), scene.size());
  ASSERT_EQ(motions.cols(), 6);
  EXPECT_EQ(motions.colPivHouseholderQr().rank(), 6);
  const Eigen::MatrixXd K = scene.stiffness(scene.zero());
  EXPECT_LE((K * motions).norm(), 1e-13 * K.norm() * motions.norm());
}

// The tangent of a rotated body has no stiffness against further rotation.
TEST(RigidMotions, AreThoseOfTheCurrentShape) {
  const BuiltTestScene scene = body("");
  const Mat3 R = Random(31).rotation();
  const Vector q = scene.dofs([&](const Vec3& x) { return Vec3(R * x - x + Vec3(1, 2, 3)); });
  const Eigen::MatrixXd motions = scene.model().rigid_motions(q), K = scene.stiffness(q);
  EXPECT_LE((K * motions).norm(), 1e-12 * K.norm() * motions.norm());
}

TEST(RigidMotions, OfAHeldBodyAreThoseOfItsFreeCoordinates) {
  const BuiltTestScene free = body(""), held = body("clamps: [{surface: x0, components: [x, z]}]");
  const Eigen::MatrixXd all = free.model().rigid_motions(free.zero()), some = held.model().rigid_motions(held.zero());
  ASSERT_LT(some.rows(), all.rows());
  const auto& coordinate = held.model().pattern().coordinate;
  ASSERT_EQ(static_cast<Eigen::Index>(coordinate.size()), some.rows());
  for (std::size_t i = 0; i < coordinate.size(); ++i)
    EXPECT_EQ(some.row(static_cast<Eigen::Index>(i)), all.row(coordinate[i])) << i;
}

}  // namespace
}  // namespace orthodyn::rigid_motions_test
