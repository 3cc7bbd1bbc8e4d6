// Strains at which the corotational law loses strong ellipticity, for fibres under uniaxial stress.
#include <gtest/gtest.h>

#include "lib/element/corotational_law.h"
#include "tests/element/states.h"

namespace orthodyn::ellipticity_test {
namespace {

// A fibre along axis 1 with axial strain e under uniaxial stress. curvature(i, j): second derivative of the energy in
// the direction e_i e_j^T. kink() and slide(): its closed forms for (1, 0) and (0, 1).
class Fibre {
 public:
  Fibre(double ratio, double e)
      : c_(stable_family({ratio, 1, 1}, 0.3)), s1_(1 + e), s2_(1 - c_.nu12 * e), sigma1_(ratio * e) {}
  double curvature(int i, int j) const {
    const Mat3 F = Vec3(s1_, s2_, s2_).asDiagonal();
    const Mat9 H = in_space(
        CorotationalLaw(stiffness(c_)).tangent(F - Mat3::Identity(), Mat3::Identity(), TangentKind::exact, 0, nullptr));
    return H(i + 3 * j, i + 3 * j);
  }
  double kink() const { return (4 * c_.g12 * s2_ * s2_ + sigma1_ * (2 * s2_ + s1_)) / ((s1_ + s2_) * (s1_ + s2_)); }
  double slide() const { return (4 * c_.g12 * s1_ * s1_ - sigma1_ * s1_) / ((s1_ + s2_) * (s1_ + s2_)); }
  double shear_modulus() const { return c_.g12; }

 private:
  OrthotropicConstants c_;
  double s1_, s2_, sigma1_;
};

TEST(Ellipticity, CurvaturesOfAStretchedFibreAreThoseOfTheFormulas) {
  for (const double ratio : {10.0, 100.0, 1000.0})
    for (const double e : {-0.05, -0.01, 0.0, 0.02, 0.09}) {
      const Fibre fibre_at(ratio, e);
      EXPECT_NEAR(fibre_at.curvature(1, 0), fibre_at.kink(), 64 * kEps * ratio);
      EXPECT_NEAR(fibre_at.curvature(0, 1), fibre_at.slide(), 64 * kEps * ratio);
    }
}

TEST(Ellipticity, IsLostByKinkingAtTheCompressiveLimit) {
  EXPECT_GT(Fibre(10, -0.215).curvature(1, 0), 0);  // limit: -22 %, to two digits
  EXPECT_LT(Fibre(10, -0.225).curvature(1, 0), 0);
  EXPECT_GT(Fibre(100, -0.0655).curvature(1, 0), 0);  // limit: -6.6 %
  EXPECT_LT(Fibre(100, -0.0665).curvature(1, 0), 0);
}

TEST(Ellipticity, IsLostBySlidingAtTheTensileLimit) {
  for (const double ratio : {100.0, 1000.0}) {
    const double mu = Fibre(ratio, 0).shear_modulus(), limit = 4 * mu / (ratio - 4 * mu);
    EXPECT_GT(Fibre(ratio, limit * (1 - 1e-6)).curvature(0, 1), 0);
    EXPECT_LT(Fibre(ratio, limit * (1 + 1e-6)).curvature(0, 1), 0);
  }
}

}  // namespace
}  // namespace orthodyn::ellipticity_test
