// The choice of `auto`: each threshold from both sides, and the safety factor of central differences derived from the
// allowed errors.
#include "integrators/automatic/cost_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/contract/models.h"

namespace orthodyn::cost_estimate_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string method(const CostEstimate& cost, double rtol, double most = kInfinity) {
  return choose_method(cost, rtol, most).method;
}

// No explicit method and very little damping.
CostEstimate implicit_only(double damping_ratio = 0) {
  return {.damping_ratio = damping_ratio, .explicit_steps = kInfinity, .phase = 10, .solve_cost = 1, .factor_cost = 10};
}

// At rtol 1e-3 the energy error gives the safety sqrt(0.1). An implicit method takes 10 + 7 phase = 80 steps, each with
// 4 (1 + 1) forces for Newton iterations and 0.3 (5 + 10) for tangents and factors.
constexpr double kImplicitCost = 80 * (8 + 4.5);
const double kSafetyByEnergy = std::sqrt(0.1);

CostEstimate with_explicit_cost(double forces) {
  CostEstimate cost = implicit_only();
  cost.explicit_steps = forces * kSafetyByEnergy;
  return cost;
}

TEST(MethodChoice, IsExplicitWhereThatTakesFewerForces) {
  const auto choice = choose_method(with_explicit_cost(0.99 * kImplicitCost), 1e-3, kInfinity);
  EXPECT_EQ(choice.method, "central_differences");
  ASSERT_TRUE(choice.safety);
  EXPECT_DOUBLE_EQ(*choice.safety, kSafetyByEnergy);
  EXPECT_EQ(method(with_explicit_cost(1.01 * kImplicitCost), 1e-3), "tr_bdf2");
}

TEST(MethodChoice, IsExplicitWithinTheStepsAllowed) {
  const CostEstimate cost = with_explicit_cost(500);
  EXPECT_EQ(method(cost, 1e-3, 501), "central_differences");
  EXPECT_EQ(method(cost, 1e-3, 499), "tr_bdf2");
  EXPECT_EQ(method(cost, 1e-3, 0), "tr_bdf2");
}

TEST(MethodChoice, IsNeverExplicitWithoutACriticalStep) {
  EXPECT_EQ(method(implicit_only(), 1e-3), "tr_bdf2");
  EXPECT_FALSE(choose_method(implicit_only(), 1e-3, kInfinity).safety);
}

TEST(MethodChoice, IsMultistepWhereTheMotionIsWellDamped) {
  EXPECT_EQ(method(implicit_only(1.01e-3), 1e-3), "cvode_bdf");
  EXPECT_EQ(method(implicit_only(0.99e-3), 1e-3), "tr_bdf2");
}

TEST(MethodChoice, AsksForMoreDampingAtALooseTolerance) {
  EXPECT_EQ(method(implicit_only(5.05e-3), 5e-3), "cvode_bdf");
  EXPECT_EQ(method(implicit_only(4.95e-3), 5e-3), "tr_bdf2");
  EXPECT_EQ(method(implicit_only(4.95e-3), 4.9e-3), "cvode_bdf");
}

TEST(MethodChoice, IsOfHighOrderAtATightTolerance) {
  EXPECT_EQ(method(implicit_only(), 1e-4), "arkode_dirk");
  EXPECT_EQ(method(implicit_only(), 1.01e-4), "tr_bdf2");
}

// The phase lag of a method of order 2 is 1.2e-3 per radian at rtol 1e-3 and 1.2e-2/10^(1/3) at 1e-2; 20 rtol is
// accepted.
TEST(MethodChoice, IsOfHighOrderWhereTheLagOfManyPeriodsAddsUp) {
  const auto over = [](double phase, double rtol) {
    CostEstimate cost = implicit_only();
    cost.known_phase = phase;
    return method(cost, rtol);
  };
  EXPECT_EQ(over(16.5, 1e-3), "tr_bdf2");
  EXPECT_EQ(over(16.8, 1e-3), "arkode_dirk");
  EXPECT_EQ(over(35.7, 1e-2), "tr_bdf2");
  EXPECT_EQ(over(36.1, 1e-2), "arkode_dirk");
}

TEST(MethodChoice, ExplainsItselfWithoutAColonSinceThatBecomesAValueOfTheInput) {
  for (const auto& cost : {with_explicit_cost(1), implicit_only(1), implicit_only()})
    for (const double rtol : {1e-3, 1e-6}) {
      const std::string rationale = choose_method(cost, rtol, kInfinity).rationale;
      EXPECT_FALSE(rationale.empty());
      EXPECT_EQ(rationale.find(':'), std::string::npos) << rationale;
    }
}

TEST(Safety, MakesThePhaseErrorAtTheEndTenTimesTheTolerance) {
  for (const double rtol : {1e-3, 1e-5}) {
    const CostEstimate cost{.explicit_steps = 200, .phase = 100};
    const double s = safety_of_central_differences(cost, rtol);
    // The relative frequency error of the leapfrog is (omega h)^2 / 24.
    const double omega_h = s * cost.phase / cost.explicit_steps;
    EXPECT_NEAR(cost.phase * omega_h * omega_h / 24, 10 * rtol, 1e-12 * rtol);
  }
}

TEST(Safety, KeepsTheEnergyOfFastVibrationsToAHundredTolerances) {
  // With a known frequency of the motion, its phase error decides.
  EXPECT_EQ(safety_of_central_differences({.explicit_steps = 200, .phase = 10, .known_phase = 100}, 1e-3),
            safety_of_central_differences({.explicit_steps = 200, .phase = 100}, 1e-3));
  const CostEstimate slow{.explicit_steps = 1e6, .phase = 1};
  for (const double rtol : {1e-3, 1e-5})
    EXPECT_DOUBLE_EQ(std::pow(safety_of_central_differences(slow, rtol), 2), 100 * rtol);
}

TEST(Safety, StaysBelowTheCriticalStep) {
  EXPECT_EQ(safety_of_central_differences({.explicit_steps = kInfinity, .phase = 1}, 0.1), 0.9);
  EXPECT_EQ(safety_of_central_differences({.explicit_steps = 1e6, .phase = 1}, 0.0082), 0.9);
  EXPECT_LT(safety_of_central_differences({.explicit_steps = 1e6, .phase = 1}, 0.0080), 0.9);
}

// Frequencies 2 and 20 rad/s, D = beta K: the critical step is 2 / (delta + sqrt(delta^2 + kappa)) of the faster mode.
TEST(CostEstimate, IsThatOfAModelWithKnownModes) {
  const double beta = 0.01, kappa = 400, delta = beta * kappa, span = 3, omega = 2;
  const LinearModel model({.mass = Matrix::Identity(2, 2),
                           .stiffness = Matrix(Vector{{4, kappa}}.asDiagonal()),
                           .beta = beta,
                           .start = Vector::Ones(2),
                           .end = span});
  const Task task{[] { return Scales{}; }, model.initial(), model.end(), 1};
  // The position scale is a tenth of the motion.
  const auto cost = estimate_cost(model, task, {.position = 0.1, .velocity = omega}, "cholesky");
  EXPECT_DOUBLE_EQ(cost.phase, span * omega);
  EXPECT_NEAR(cost.damping_ratio, beta * omega / 2, 1e-9);
  EXPECT_NEAR(cost.explicit_steps, span * (delta + std::sqrt(delta * delta + kappa)) / 2, 1e-6);
  EXPECT_GT(cost.solve_cost, 0);
  EXPECT_GT(cost.factor_cost, 0);
}

TEST(CostEstimate, OfAModelWithoutDampingHasNone) {
  const auto model = harmonic_oscillator();
  const Task task{[] { return Scales{}; }, model.initial(), model.end(), 1};
  EXPECT_EQ(estimate_cost(model, task, {1, 3}, "cholesky").damping_ratio, 0);
}

}  // namespace
}  // namespace orthodyn::cost_estimate_test
