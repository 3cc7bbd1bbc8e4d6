// The stress of swelling against its energy, in regular and in blended states.
#include "lib/element/swelling_law.h"

#include <gtest/gtest.h>

#include "lib/core/errors.h"
#include "lib/element/corotational_law.h"
#include "tests/element/batch_checks.h"
#include "tests/element/states.h"

namespace orthodyn::swelling_law_test {
namespace {

double energy(const Mat3& F, const Mat3& Q, const Mat3& s) {
  return swelling_energy(everywhere(F - Q), everywhere(Q), everywhere(s))[0];
}
Mat3 stress(const Mat3& F, const Mat3& Q, const Mat3& s) {
  return first_lane(swelling_stress(everywhere(F - Q), everywhere(Q), everywhere(s)));
}

struct Sample {
  Mat3 F, Q, s;
};
Sample sample(Random& random, const Vec3& stretches) {
  const Mat3 s = random.matrix();
  return {random_state(random, stretches).F(), random.rotation(), s + s.transpose()};
}

// Regular stretches, and stretches with 0 < chi < 1 (blend.h).
const Vec3 kStretches[] = {{1.3, 1, 0.8}, {2, 0.9, 0.5}, {1.1, 0.8, -0.7}, {0.5, 0.4, -0.2}, {1, 0.03, 0.02}};

TEST(SwellingLaw, StressIsTheGradientOfTheEnergy) {
  Random random(301);
  for (const Vec3& stretches : kStretches) {
    const auto [F, Q, s] = sample(random, stretches);
    const Mat3 P = stress(F, Q, s), d = random.matrix();
    expect_order_two([&](double h) {
      const Mat3 step = h * d;
      return std::abs((energy(F + step, Q, s) - energy(F - step, Q, s)) / (2 * h) - contract<double>(P, d)) / P.norm();
    });
  }
}

TEST(SwellingLaw, ModuliAreTheDerivativeOfTheStress) {
  Random random(302);
  for (const Vec3& stretches : {kStretches[0], kStretches[1]}) {
    const auto [F, Q, s] = sample(random, stretches);
    Mat9T<Batch> K = Mat9T<Batch>::Zero();
    add_swelling_moduli(everywhere(F - Q), everywhere(Q), everywhere(s), K);
    const Mat9 moduli = K.unaryExpr([](const Batch& x) { return x[0]; });
    EXPECT_LE((moduli - moduli.transpose()).norm(), 1e-13 * moduli.norm());
    const Mat3 d = random.matrix();
    const Vector expected = moduli * Vector(d.reshaped());
    expect_order_two([&](double h) {
      const Mat3 step = h * d, change = (stress(F + step, Q, s) - stress(F - step, Q, s)) / (2 * h);
      return (Vector(change.reshaped()) - expected).norm() / moduli.norm();
    });
  }
}

TEST(SwellingLaw, ExertsNoTorqueAndTurnsWithTheBody) {
  Random random(303);
  for (const Vec3& stretches : kStretches) {
    const auto [F, Q, s] = sample(random, stretches);
    const Mat3 P = stress(F, Q, s), turn = random.rotation();
    EXPECT_LE(torque_fraction(P, F), 1e-12);
    EXPECT_LE((stress(turn * F, Q, s) - turn * P).norm(), 1e-12 * P.norm());
    EXPECT_NEAR(energy(turn * F, Q, s), energy(F, Q, s), 1e-12 * s.norm());
  }
}

// The elastic law alone gives the force of a state that is swollen by e* without stress; both together give none.
TEST(SwellingLaw, CancelsTheElasticStressOfAFreelySwollenBody) {
  Random random(304);
  const CorotationalLaw<OrthotropicStiffness> law(fibre(10));
  const Mat3 swelling = Vec3(-0.02, 0.1, 0.25).asDiagonal(), Q = random.rotation(), R = random.rotation();
  const Mat3 F = R * Q * (Mat3::Identity() + swelling), elastic = law.stress<double>(F - Q, Q);
  EXPECT_GE(elastic.norm(), 0.1);
  EXPECT_LE((elastic + stress(F, Q, fibre(10).stress<double>(swelling))).norm(), 1e-13 * elastic.norm());
}

TEST(SwellingLaw, MeanStressDoesTheWorkThatTheEnergyLoses) {
  Random random(305);
  for (int i = 0; i < 20; ++i) {
    const auto [F0, Q, s] = sample(random, kStretches[0]);
    const Mat3 F1 = random_state(random, kStretches[1]).F();
    const Mat3 P =
        first_lane(mean_swelling_stress(everywhere(F0 - Q), everywhere(F1 - Q), everywhere(Q), everywhere(s)));
    const double work = contract<double>(P, Mat3(F1 - F0));
    EXPECT_NEAR(work, energy(F1, Q, s) - energy(F0, Q, s), 1e-13 * P.norm() * (F1 - F0).norm());
    EXPECT_LE(torque_fraction(P, Mat3(F0 + F1)), 1e-13);
  }
}

TEST(SwellingLaw, RefusesMeanStressesOfInvertedStates) {
  Random random(306);
  const auto [F, Q, s] = sample(random, kStretches[3]);
  EXPECT_THROW(mean_swelling_stress(everywhere(F - Q), everywhere(F - Q), everywhere(Q), everywhere(s)),
               RecoverableError);
}

// Lanes with regular and with blended states in one batch.
TEST(SwellingLaw, LanesDoNotDependOnEachOther) {
  Random random(307);
  Mat3T<Batch> H, Q, s;
  std::vector<Sample> lanes;
  for (int l = 0; l < Batch::kLanes; ++l) {
    lanes.push_back(sample(random, kStretches[l % 5]));
    const Mat3 own_H = lanes.back().F - lanes.back().Q;
    for (int i = 0; i < 9; ++i) {
      const auto set = [&](Mat3T<Batch>& all, double value) {
        double values[Batch::kLanes];
        all(i).store(values);
        values[l] = value;
        all(i) = Batch::load(values);
      };
      set(H, own_H(i));
      set(Q, lanes.back().Q(i));
      set(s, lanes.back().s(i));
    }
  }
  const Mat3T<Batch> P = swelling_stress(H, Q, s);
  for (int l = 0; l < Batch::kLanes; ++l) {
    const auto& [F, axes, own_s] = lanes[static_cast<std::size_t>(l)];
    const Mat3 own = P.unaryExpr([&](const Batch& x) { return x[l]; });
    EXPECT_LE((own - stress(F, axes, own_s)).norm(), 1e-14 * own.norm()) << l;
  }
}

}  // namespace
}  // namespace orthodyn::swelling_law_test
