// Strains and stresses of small displacements have relative errors of a few ulp.
#include <gtest/gtest.h>

#include "lib/element/linear_law.h"
#include "lib/element/warped_law.h"
#include "tests/element/states.h"

namespace orthodyn::strain_test {
namespace {

const Mat3 kQ = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();

// (F - I) Q for F = R (I + e), where R is the rotation by the angle |w| about w. e and w are in material axes. The
// result is accurate to a few ulp of w and e.
Mat3 gradient_of(const Mat3& e, const Vec3& w) {
  const double angle = w.norm(), half = std::sin(angle / 2);
  const Mat3 W = cross_matrix<double>(w / angle);
  const Mat3 turn = std::sin(angle) * W + 2 * half * half * W * W;  // R - I
  return kQ * (turn + e + turn * e);
}

Mat3 stretch_strain_of(const Mat3& H) {
  return stretch_strain<double>(H, kQ, polar(deformation_gradient<double>(H, kQ), kQ).S);
}

TEST(StretchStrain, OfSmallMotionsIsRightToAFewUlpOfThem) {
  Random random(61);
  for (const double size : {1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-100})
    for (int sample = 0; sample < 100; ++sample) {
      const Mat3 e = size * symmetric_part<double>(random.matrix());
      const Vec3 w = size * random.vector();
      EXPECT_LE((stretch_strain_of(gradient_of(e, w)) - e).norm(), 16 * kEps * (e.norm() + w.norm())) << size;
    }
}

// For large strains the strain must be computed as S - I, without cancellation. S^2 - I would lose digits.
TEST(StretchStrain, OfLargeStretchesIsRightToAFewUlp) {
  Random random(62);
  for (const Vec3& s : {Vec3(1e6, 2, 0.1), Vec3(3, 1, 1e-8), Vec3(2, 1, -0.5), Vec3(1, 0.9, -0.8)}) {
    const auto state = random_state(random, s);
    const Mat3 S = polar(Mat3(state.F() * kQ), kQ).S;
    const Mat3 expected = kQ.transpose() * state.S() * kQ - Mat3::Identity();
    EXPECT_LE((stretch_strain<double>(state.F() * kQ - kQ, kQ, S) - expected).norm(), 64 * kEps * s.norm())
        << s.transpose();
  }
}

TEST(StretchStrain, OfABatchIsThatOfItsLanes) {
  Random random(63);
  for (const double size : {1e-12, 0.3, 3.0}) {
    Mat3T<Batch> H, S;
    std::array<Mat3, Batch::kLanes> expected;
    std::array<double, Batch::kLanes> values;
    std::array<Mat3, Batch::kLanes> gradients, stretches;
    for (std::size_t l = 0; l < values.size(); ++l) {
      const auto state = random_state(random, Vec3::Ones() + size * Vec3(1, 0.3, 0.1));
      gradients[l] = size < 1e-3 ? gradient_of(size * symmetric_part<double>(random.matrix()), size * random.vector())
                                 : Mat3(state.F() * kQ - kQ);
      stretches[l] = polar(deformation_gradient<double>(gradients[l], kQ), kQ).S;
      expected[l] = stretch_strain<double>(gradients[l], kQ, stretches[l]);
    }
    const auto pack = [&](const std::array<Mat3, Batch::kLanes>& lanes, Mat3T<Batch>& out) {
      for (int i = 0; i < 9; ++i) {
        for (std::size_t l = 0; l < values.size(); ++l) values[l] = lanes[l](i);
        out(i) = Batch::load(values.data());
      }
    };
    pack(gradients, H);
    pack(stretches, S);
    const Mat3T<Batch> strain = stretch_strain<Batch>(H, kQ, S);
    for (std::size_t l = 0; l < values.size(); ++l)
      for (int i = 0; i < 9; ++i) EXPECT_NEAR(strain(i)[static_cast<int>(l)], expected[l](i), 4 * kEps * size) << size;
  }
}

// For strains below round-off of 1 every law must reduce to sigma = C e.
template <class Law, class C>
void expect_small_stress(const Law& law, const C& stiffness) {
  Random random(64);
  for (int sample = 0; sample < 20; ++sample) {
    const Mat3 e = 1e-17 * symmetric_part<double>(random.matrix());
    const Mat3 H = gradient_of(e, 1e-17 * random.vector());
    const Mat3 sigma = stiffness.template stress<double>(e);
    EXPECT_LE((law.template stress<double>(H, kQ) - kQ * sigma).norm(), 64 * kEps * voigt(stiffness).norm() * 1e-17);
    const double energy = 0.5 * contract<double>(sigma, e);
    EXPECT_NEAR(law.template energy<double>(H, kQ), energy, 64 * kEps * voigt(stiffness).norm() * 1e-34);
    EXPECT_LE((law.observe(H, kQ).strain - e).norm(), 64 * kEps * 1e-17);
  }
}

TEST(Laws, OfSmallMotionsGiveTheStressToAFewUlp) {
  const OrthotropicStiffness wood = stiffness(spruce());
  expect_small_stress(CorotationalLaw(wood), wood);
  expect_small_stress(CorotationalLaw(kIsotropic), kIsotropic);
  expect_small_stress(CorotationalLaw(turned(wood, kQ)), turned(wood, kQ));
  expect_small_stress(WarpedLaw(wood, WarpedTangent::rotated), wood);
  expect_small_stress(LinearLaw(wood), wood);
}

TEST(Laws, OfSmallMotionsKeepTheWorkOfADiscreteStep) {
  Random random(65);
  const CorotationalLaw law(stiffness(spruce()));
  for (int sample = 0; sample < 20; ++sample) {
    const auto next = [&] {
      return gradient_of(1e-12 * symmetric_part<double>(random.matrix()), 1e-12 * random.vector());
    };
    const Mat3 H0 = next(), H1 = next();
    const double work = contract<double>(law.mean_stress(H0, H1, kQ), H1 - H0);
    const double before = law.energy<double>(H0, kQ), after = law.energy<double>(H1, kQ);
    EXPECT_NEAR(work, after - before, 1e-11 * (before + after));
  }
}

}  // namespace
}  // namespace orthodyn::strain_test
