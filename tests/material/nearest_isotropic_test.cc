// The isotropic tensor nearest to C (Fedorov 1968).
#include <gtest/gtest.h>

#include "lib/material/stiffness.h"
#include "tests/material/constants.h"

namespace orthodyn::nearest_isotropic_test {
namespace {

// The Euclidean norm of the difference of both fourth-order tensors.
double distance(const OrthotropicStiffness& c, const IsotropicStiffness& iso) {
  return mandel(voigt(c) - voigt(as_orthotropic(iso))).norm();
}

TEST(NearestIsotropic, OfAnIsotropicTensorIsTheTensorItself) {
  const IsotropicStiffness iso = nearest_isotropic(as_orthotropic(IsotropicStiffness{2, 3}));
  EXPECT_NEAR(iso.lambda, 2, 16 * kEps);
  EXPECT_NEAR(iso.mu, 3, 16 * kEps);
}

TEST(NearestIsotropic, IsNearerThanItsNeighbours) {
  Random random(15);
  for (int sample = 0; sample < 50; ++sample) {
    const auto c = stiffness(random_stable(random));
    const auto iso = nearest_isotropic(c);
    const double h = 1e-3 * voigt(c).norm();
    for (const double angle : {0.0, 0.7, 1.6, 2.4, 3.1, 4.0, 4.8, 5.5})
      EXPECT_LT(distance(c, iso), distance(c, {iso.lambda + h * std::cos(angle), iso.mu + h * std::sin(angle)}));
  }
}

TEST(NearestIsotropic, OfAStableTensorIsStable) {
  Random random(16);
  for (int sample = 0; sample < 200; ++sample) {
    const auto iso = nearest_isotropic(stiffness(random_stable(random)));
    EXPECT_GT(iso.mu, 0);
    EXPECT_GT(3 * iso.lambda + 2 * iso.mu, 0);
  }
}

}  // namespace
}  // namespace orthodyn::nearest_isotropic_test
