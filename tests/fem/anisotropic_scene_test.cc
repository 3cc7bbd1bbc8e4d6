// A scene whose material has 21 constants is the scene of the orthotropic material that they describe.
#include <gtest/gtest.h>

#include "lib/material_axes/frame.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::anisotropic_scene_test {
namespace {

// kTurnedAxes as a matrix.
Mat3 turned_axes() { return frame({0.781639, 0.550117, -0.293958}, {-0.482929, 0.832030, 0.272956}); }

BuiltTestScene scene_with(const std::string& material, const std::string& axes, const std::string& elasticity) {
  return BuiltTestScene("mesh: {type: box, size: [1, 1, 1], cells: [2, 1, 1], order: 1}\nmaterials: {m: " + material +
                        "}\nregions: {all: {material: m" + axes + "}}\nclamps: [{surface: x0}]\ntime: {end: 1}\n" +
                        "damping: {stiffness: 0.1}\nelasticity: {" + elasticity + "}\n");
}

struct Both {
  explicit Both(const std::string& elasticity)
      : nine(scene_with(fibre_material(10), ", axes: " + kTurnedAxes, elasticity)),
        full(scene_with(turned_fibre_material(10, turned_axes()), "", elasticity)) {}
  BuiltTestScene nine, full;
};

class AnisotropicScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Laws, AnisotropicScene,
                         testing::Values("", "kinematics: linear", "corotation: warped",
                                         "corotation: warped, warped_tangent: unsymmetric"));

TEST_P(AnisotropicScene, HasTheForceOfTheOrthotropicOne) {
  const Both both(GetParam());
  Random random(120);
  for (const double amplitude : {0.05, 1.0}) {  // regular, and with inverted elements
    const Vector q = random_dofs(random, both.nine.size(), amplitude), v = random_dofs(random, both.nine.size(), 1);
    const Vector expected = both.nine.force(q, v);
    EXPECT_LE((both.full.force(q, v) - expected).norm(), 1e-11 * expected.norm()) << amplitude;
    EXPECT_NEAR(both.full.scalar("energy.elastic", q, v), both.nine.scalar("energy.elastic", q, v),
                1e-11 * both.nine.scalar("energy.elastic", q, v));
  }
}

TEST_P(AnisotropicScene, HasTheStiffnessAndDampingOfTheOrthotropicOne) {
  const Both both(GetParam());
  Random random(121);
  const Vector q = random_dofs(random, both.nine.size(), 0.05);
  for (const Weights w : {Weights{0, 0, 1}, Weights{0, 1, 0}}) {
    const Eigen::MatrixXd expected = both.nine.matrix(w, q, both.nine.zero());
    EXPECT_LE((both.full.matrix(w, q, both.full.zero()) - expected).norm(), 1e-11 * expected.norm());
  }
}

TEST_P(AnisotropicScene, HasTheFrequencyBoundOfTheOrthotropicOne) {
  const Both both(GetParam());
  const auto bound = [](const BuiltTestScene& s) { return s.model().parts().elastic[0]->max_frequency_squared(1); };
  EXPECT_NEAR(bound(both.full), bound(both.nine), 1e-12 * bound(both.nine));
}

}  // namespace
}  // namespace orthodyn::anisotropic_scene_test
