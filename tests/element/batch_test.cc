// A batch of elements gives the same results as its elements one by one, and reports the lanes that it cannot evaluate.
#include <gtest/gtest.h>

#include "lib/element/corotational_law.h"
#include "lib/element/linear_law.h"
#include "lib/element/warped_law.h"
#include "tests/element/states.h"

namespace orthodyn::batch_test {
namespace {

const OrthotropicStiffness kStiff{12, 5, 3, 2, 1, 1.5, 2, 1, 1.2};
const Mat3 kAxes = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();

// F Q with F close to a random rotation, Q = kAxes. The element of lane `inverted` is inverted; -1: none.
std::array<Mat3, Batch::kLanes> states(double strain, int inverted = -1) {
  std::array<Mat3, Batch::kLanes> out;
  std::srand(7);
  for (int l = 0; l < Batch::kLanes; ++l) {
    const Mat3 R = Eigen::Quaterniond(Eigen::Vector4d::Random().normalized()).toRotationMatrix();
    Mat3 U = Mat3::Identity() + strain * Mat3::Random();
    if (l == inverted) U.col(0) *= -0.5;
    out[static_cast<std::size_t>(l)] = R * U * kAxes;
  }
  return out;
}

Mat3T<Batch> pack(const std::array<Mat3, Batch::kLanes>& lanes) {
  Mat3T<Batch> all;
  for (int i = 0; i < 9; ++i) {
    double values[Batch::kLanes];
    for (int l = 0; l < Batch::kLanes; ++l) values[l] = lanes[static_cast<std::size_t>(l)](i);
    all(i) = Batch::load(values);
  }
  return all;
}

// Converts F Q to (F - I) Q, the argument of the laws.
Mat3T<Batch> pack_gradients(std::array<Mat3, Batch::kLanes> lanes) {
  for (Mat3& F : lanes) F -= kAxes;
  return pack(lanes);
}

template <class Law>
void expect_lanes_equal(const Law& law, double strain) {
  const auto F = states(strain), rates = states(1);
  const auto H_batch = pack_gradients(F), rate_batch = pack(rates);
  for (const bool damped : {false, true}) {
    Batch::Mask good;
    const auto P = law.batch_stress(H_batch, kAxes, damped ? &rate_batch : nullptr, 0.3, good);
    ASSERT_TRUE(all(good));
    for (int l = 0; l < Batch::kLanes; ++l) {
      const auto& rate = rates[static_cast<std::size_t>(l)];
      const Mat3 expected =
          law.template stress<double>(F[static_cast<std::size_t>(l)] - kAxes, kAxes, damped ? &rate : nullptr, 0.3);
      for (int i = 0; i < 9; ++i) EXPECT_NEAR(P(i)[l], expected(i), 1e-13 * (0.1 * kStiff.c11 + expected.norm()));
    }
  }
  Batch::Mask good;
  const Batch power = law.batch_dissipation(H_batch, kAxes, rate_batch, 0.3, good);
  for (int l = 0; l < Batch::kLanes; ++l) {
    const double expected =
        law.dissipation(F[static_cast<std::size_t>(l)] - kAxes, kAxes, rates[static_cast<std::size_t>(l)], 0.3);
    EXPECT_NEAR(power[l], expected, 1e-12 * expected);
  }
}

TEST(Batch, OfTheCorotationalLawEqualsItsElements) {
  for (const double strain : {0.0, 1e-6, 0.05, 0.3}) expect_lanes_equal(CorotationalLaw(kStiff), strain);
  expect_lanes_equal(CorotationalLaw(IsotropicStiffness{2, 1}), 0.2);
}

TEST(Batch, OfAnAnisotropicMaterialEqualsItsElements) {
  Mat6 C = voigt(kStiff);
  C(0, 3) = C(3, 0) = 0.5;
  C(2, 4) = C(4, 2) = -0.3;
  C(4, 5) = C(5, 4) = 0.2;
  const AnisotropicStiffness full{C};
  for (const double strain : {0.0, 0.05, 0.3}) expect_lanes_equal(CorotationalLaw(full), strain);
  expect_lanes_equal(WarpedLaw(full, WarpedTangent::rotated), 0.2);
  expect_lanes_equal(LinearLaw(full), 0.2);
}

TEST(Batch, OfTheWarpedAndTheLinearLawEqualTheirElements) {
  expect_lanes_equal(WarpedLaw(kStiff, WarpedTangent::rotated), 0.2);
  expect_lanes_equal(LinearLaw(kStiff), 0.2);
}

template <class Law>
void expect_mean_stresses_equal(const Law& law, double strain) {
  const auto F0 = states(strain), F1 = states(-0.5 * strain);
  Batch::Mask good;
  const auto P = law.batch_mean_stress(pack_gradients(F0), pack_gradients(F1), kAxes, good);
  ASSERT_TRUE(all(good));
  for (std::size_t l = 0; l < Batch::kLanes; ++l) {
    const Mat3 expected = law.mean_stress(F0[l] - kAxes, F1[l] - kAxes, kAxes);
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(P(i)[static_cast<int>(l)], expected(i), 1e-13 * (0.1 * kStiff.c11 + expected.norm()));
  }
}

TEST(Batch, OfMeanStressesEqualsThoseOfItsElements) {
  for (const double strain : {1e-6, 0.05, 0.3}) {
    expect_mean_stresses_equal(CorotationalLaw(kStiff), strain);
    expect_mean_stresses_equal(CorotationalLaw(IsotropicStiffness{2, 1}), strain);
    expect_mean_stresses_equal(LinearLaw(kStiff), strain);
  }
}

// A flattened element (det F = 0) must be reported, too. Its energy is not blended, but mean stresses need det F > 0 at
// both ends.
TEST(Batch, OfMeanStressesLeavesALaneThatIsInvertedAtEitherEnd) {
  const CorotationalLaw law(kStiff);
  auto flat = states(0.1);
  flat[1].col(0).setZero();
  for (const auto& other : {states(0.1, 1), flat})
    for (const bool first : {true, false}) {
      const auto H = pack_gradients(states(0.1)), H_other = pack_gradients(other);
      Batch::Mask good;
      law.batch_mean_stress(first ? H_other : H, first ? H : H_other, kAxes, good);
      for (int l = 0; l < Batch::kLanes; ++l) EXPECT_EQ(good[l] != 0, l != 1) << "lane " << l;
    }
}

template <class C>
void expect_tangents_equal(const C& stiffness, double strain) {
  const CorotationalLaw<C> law(stiffness);
  const auto F = states(strain);
  for (const auto kind : {TangentKind::exact, TangentKind::gauss_newton}) {
    Batch::Mask good;
    typename CorotationalLaw<C>::BatchForm damping;
    const auto form = law.batch_tangent(pack_gradients(F), kAxes, kind, 0.3, &damping, good);
    ASSERT_TRUE(all(good));
    auto moduli = expand(form), damping_moduli = expand(damping);
    turn_to_space<Batch>(form.R, moduli);
    turn_to_space<Batch>(damping.R, damping_moduli);
    for (int l = 0; l < Batch::kLanes; ++l) {
      typename CorotationalLaw<C>::Form damping_of_one;
      const auto one = law.tangent(F[static_cast<std::size_t>(l)] - kAxes, kAxes, kind, 0.3, &damping_of_one);
      const auto expected = in_space(one), expected_damping = in_space(damping_of_one);
      for (int i = 0; i < 81; ++i) {
        EXPECT_NEAR(moduli(i)[l], expected(i), 1e-13 * expected.norm());
        EXPECT_NEAR(damping_moduli(i)[l], expected_damping(i), 1e-13 * expected_damping.norm());
      }
    }
  }
}

TEST(Batch, OfTangentsEqualsThoseOfItsElements) {
  Mat6 C = voigt(kStiff);
  C(0, 3) = C(3, 0) = 0.5;
  for (const double strain : {0.0, 1e-6, 0.05, 0.3}) {
    expect_tangents_equal(kStiff, strain);
    expect_tangents_equal(IsotropicStiffness{2, 1}, strain);
    expect_tangents_equal(AnisotropicStiffness{C}, strain);
  }
}

TEST(Batch, LeavesAnInvertedLaneToTheScalarLawAndDoesTheOthers) {
  const int inverted = Batch::kLanes - 2;
  const auto F = states(0.1, inverted);
  const CorotationalLaw law(kStiff);
  Batch::Mask good;
  const auto P = law.batch_stress(pack_gradients(F), kAxes, nullptr, 0, good);
  for (int l = 0; l < Batch::kLanes; ++l) {
    EXPECT_EQ(good[l] != 0, l != inverted) << "lane " << l;
    if (l == inverted) continue;
    const Mat3 expected = law.stress<double>(F[static_cast<std::size_t>(l)] - kAxes, kAxes);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(P(i)[l], expected(i), 1e-13 * expected.norm());
  }
}

TEST(Batch, MarksLanesThatAreNotFinite) {
  auto F = states(0.1);
  F[1](2, 0) = std::numeric_limits<double>::quiet_NaN();
  F[2].setZero();
  Batch::Mask good;
  CorotationalLaw(kStiff).batch_stress(pack_gradients(F), kAxes, nullptr, 0, good);
  EXPECT_EQ(good[1], 0);
  EXPECT_EQ(good[2], 0);
  EXPECT_NE(good[0], 0);
}

}  // namespace
}  // namespace orthodyn::batch_test
