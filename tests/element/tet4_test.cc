#include "lib/element/tet4.h"

#include <gtest/gtest.h>

#include "lib/element/corotational_law.h"
#include "tests/element/states.h"

namespace orthodyn::tet4_test {
namespace {

// Edge vectors of a random tetrahedron of positive volume.
Mat3 random_edges(Random& random) {
  for (;;) {
    const Mat3 edges = random.matrix();
    if (edges.determinant() > 0.05) return edges;
  }
}

TEST(Tet4, OfTheUnitTetHasAVolumeOfOneSixth) {
  EXPECT_DOUBLE_EQ(Tet4::point(0, Mat3::Identity(), Mat3::Identity()).volume, 1.0 / 6);
}

TEST(Tet4, TheGradientOfAnAffineMapIsItsMatrixInMaterialAxes) {
  Random random(16);
  for (int sample = 0; sample < 100; ++sample) {
    const Mat3 edges = random_edges(random), Q = random.rotation(), A = random.matrix();
    const Mat3 error = Tet4::point(0, edges, Q).gradient(A * edges) - A * Q;
    EXPECT_LE(error.norm(), 64 * kEps * edges.norm() * edges.inverse().norm());
  }
}

TEST(Tet4, AtRestHasTheMaterialAxesAsGradient) {
  Random random(17);
  const Mat3 edges = random_edges(random), Q = random.rotation();
  EXPECT_LE((Tet4::point(0, edges, Q).gradient(edges) - Q).norm(), 64 * kEps * edges.norm() * edges.inverse().norm());
}

TEST(Tet4, NodeForcesDoTheWorkOfTheStress) {
  Random random(18);
  const Mat3 edges = random_edges(random), Q = random.rotation(), P = random.matrix(), rate = random.matrix();
  const auto tet = Tet4::point(0, edges, Q);
  const double power = contract<double>(tet.node_forces(P), rate);  // node 0 does not move
  const double expected = -tet.volume * contract<double>(P, tet.gradient(rate));
  EXPECT_NEAR(power, expected, 64 * kEps * tet.volume * P.norm() * tet.B.norm() * rate.norm());
}

TEST(Tet4, NodeForcesOfTheCorotationalLawExertNoTorque) {
  Random random(19);
  const CorotationalLaw law(fibre(100));
  for (int sample = 0; sample < 100; ++sample) {
    const Mat3 edges = random_edges(random), Q = random.rotation();
    const auto tet = Tet4::point(0, edges, Q);
    const Mat3 now = random_strain(random, 0.3).F() * edges;
    const Mat3 forces = tet.node_forces(law.stress<double>(tet.gradient(now) - Q, Q));
    Vec3 torque = Vec3::Zero();
    for (int k = 0; k < 3; ++k) torque += Vec3(now.col(k)).cross(Vec3(forces.col(k)));
    EXPECT_LE(torque.norm(), 1e-13 * forces.norm() * now.norm());
  }
}

}  // namespace
}  // namespace orthodyn::tet4_test
