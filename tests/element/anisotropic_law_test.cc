// A full matrix C (21 constants) that describes an orthotropic material in rotated axes. Every law must give the same
// results as with the nine constants in their own axes. Q: axes of the full C in space. A: axes of the nine constants,
// relative to Q. A gradient F^ = F Q for the full C corresponds to F^ A for the nine constants; stress and rate
// transform alike.
#include <gtest/gtest.h>

#include <vector>

#include "lib/element/corotational_law.h"
#include "lib/element/linear_law.h"
#include "lib/element/warped_law.h"
#include "tests/element/states.h"

namespace orthodyn::anisotropic_law_test {
namespace {

const Mat3 kQ = Random(80).rotation(), kA = Random(81).rotation();
constexpr double kBeta = 0.3;
const OrthotropicStiffness kNine = stiffness(spruce());
const AnisotropicStiffness kFull = turned(kNine, kA);

// Principal stretches: regular, flat, inverted, within the zone of the blend, and close to the singular set.
const std::vector<Vec3> kStretches{{1.6, 1, 0.6},    {1.05, 1, 0.98},  {1.2, 0.7, 0},
                                   {1.2, 0.7, -0.1}, {1.1, 0.8, -0.7}, {1.1, 0.8, -0.8 + 1e-3}};

// Calls check(law of the nine constants, law of the full C) for every law.
template <class Check>
void for_each_law(Check&& check) {
  check(CorotationalLaw(kNine), CorotationalLaw(kFull));
  check(WarpedLaw(kNine, WarpedTangent::rotated), WarpedLaw(kFull, WarpedTangent::rotated));
  check(WarpedLaw(kNine, WarpedTangent::unsymmetric), WarpedLaw(kFull, WarpedTangent::unsymmetric));
  check(LinearLaw(kNine), LinearLaw(kFull));
}

// Calls check(F^ of the full C, random matrix, reach) in states of all kinds. reach = 1 / (s2 + s3) bounds the
// amplification of errors.
template <class Check>
void for_each_state(Check&& check) {
  Random random(82);
  for (const Vec3& s : kStretches)
    for (int sample = 0; sample < 5; ++sample) check(random_state(random, s).F(), random.matrix(), 1 / (s[1] + s[2]));
}

const double kSize = voigt(kNine).norm();

TEST(AnisotropicLaw, HasTheEnergyOfTheOrthotropicOneInItsAxes) {
  for_each_law([](const auto& nine, const auto& full) {
    for_each_state([&](const Mat3& F, const Mat3&, double) {
      EXPECT_NEAR(full.template energy<double>(F - kQ, kQ), nine.template energy<double>((F - kQ) * kA, kQ * kA),
                  1e-11 * kSize);
    });
  });
}

TEST(AnisotropicLaw, HasTheStressAndTheDampingOfTheOrthotropicOneInItsAxes) {
  for_each_law([](const auto& nine, const auto& full) {
    for_each_state([&](const Mat3& F, const Mat3& rate, double reach) {
      const Mat3 turned_rate = rate * kA;
      const Mat3 expected = nine.template stress<double>((F - kQ) * kA, kQ * kA, &turned_rate, kBeta);
      EXPECT_LE((full.template stress<double>(F - kQ, kQ, &rate, kBeta) * kA - expected).norm(), 1e-12 * kSize * reach);
      EXPECT_NEAR(full.dissipation(F - kQ, kQ, rate, kBeta),
                  nine.dissipation((F - kQ) * kA, kQ * kA, turned_rate, kBeta), 1e-12 * kSize * reach);
    });
  });
}

TEST(AnisotropicLaw, HasTheTangentsOfTheOrthotropicOneInItsAxes) {
  for_each_law([](const auto& nine, const auto& full) {
    for (const TangentKind kind : {TangentKind::exact, TangentKind::gauss_newton})
      for_each_state([&](const Mat3& F, const Mat3& dF, double reach) {
        typename std::decay_t<decltype(nine)>::Form nine_damping;
        typename std::decay_t<decltype(full)>::Form full_damping;
        const auto nine_form = nine.tangent((F - kQ) * kA, kQ * kA, kind, kBeta, &nine_damping);
        const auto full_form = full.tangent(F - kQ, kQ, kind, kBeta, &full_damping);
        const Mat3 turned_dF = dF * kA;
        const auto change = [](const auto& form, const Mat3& by) {
          return Mat3((in_space(form) * by.reshaped()).reshaped(3, 3));
        };
        const double tolerance = 1e-11 * kSize * reach * reach;
        EXPECT_LE((change(full_form, dF) * kA - change(nine_form, turned_dF)).norm(), tolerance);
        EXPECT_LE((change(full_damping, dF) * kA - change(nine_damping, turned_dF)).norm(), tolerance);
      });
  });
}

TEST(AnisotropicLaw, OfAFullIsotropicCIsTheIsotropicLaw) {
  const CorotationalLaw full(AnisotropicStiffness{voigt(kIsotropic)});
  const CorotationalLaw isotropic(kIsotropic);
  Random random(83);
  for (int sample = 0; sample < 20; ++sample) {
    const Mat3 F = random_strain(random, 0.4).F();
    EXPECT_LE((full.stress<double>(F - kQ, kQ) - isotropic.stress<double>(F - kQ, kQ)).norm(), 1e-13);
  }
}

TEST(AnisotropicLaw, ExertsNoTorque) {
  Random random(84);
  for (const Vec3& s : kStretches) {
    const Mat3 F = random_state(random, s).F();
    EXPECT_LE(torque_fraction(CorotationalLaw(kFull).stress<double>(F - kQ, kQ), F), 1e-12) << s.transpose();
  }
}

}  // namespace
}  // namespace orthodyn::anisotropic_law_test
