#include "integrators/renewal_policy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace orthodyn::renewal_policy_test {
namespace {

constexpr double kCost = 6;

// Iterations with a matrix that is `age` solves old.
using Iterations = double (*)(int age);

struct Averages {
  double taken, least;  // mean cost of a solve, in iterations: by the policy, and for the best fixed age
};

Averages averages(Iterations iterations) {
  constexpr int kSolves = 10'000, kOldest = 100;
  RenewalPolicy policy(kCost);
  double taken = 0;
  for (int solve = 0, age = 0; solve < kSolves; ++solve) {
    const bool renewed = solve == 0 || policy.is_due();
    age = renewed ? 0 : age + 1;
    taken += (renewed ? kCost : 0) + iterations(age);
    policy.note(iterations(age), renewed);
  }
  double least = std::numeric_limits<double>::infinity(), total = kCost;
  for (int age = 0; age < kOldest; ++age) {
    total += iterations(age);
    least = std::min(least, total / (age + 1));
  }
  return {taken / kSolves, least};
}

TEST(RenewalPolicy, CostsLittleMoreThanTheBestAgeWhereIterationsGrowWithIt) {
  const Iterations cases[] = {[](int age) { return 2.0 + age; }, [](int age) { return 2.0 + 3 * age; },
                              [](int age) { return 2.0 + age / 10; }, [](int age) { return 3.0 + 4 * age; }};
  for (const Iterations iterations : cases) {
    const Averages mean = averages(iterations);
    EXPECT_LE(mean.taken, 1.25 * mean.least);
    EXPECT_GE(mean.taken, 0.999 * mean.least);
  }
}

TEST(RenewalPolicy, KeepsAMatrixThatDoesNotAge) {
  RenewalPolicy policy(kCost);
  policy.note(3, true);
  for (int solve = 0; solve < 100; ++solve) {
    policy.note(3, false);
    EXPECT_FALSE(policy.is_due()) << solve;
  }
}

// Number of solves with a new matrix before an old one is tried again.
int new_matrices(RenewalPolicy& policy) {
  int solves = 0;
  for (; policy.is_due(); ++solves) policy.note(3, true);
  return solves;
}

void fail(RenewalPolicy& policy) { policy.note(9, true); }

TEST(RenewalPolicy, TriesAnOldMatrixAfterThreeFailuresInARow) {
  RenewalPolicy policy(kCost);
  for (int solve = 0; solve < 100; ++solve) {
    EXPECT_FALSE(policy.is_due()) << solve;
    solve % 4 == 0 ? policy.note(3, false) : fail(policy);
  }
}

TEST(RenewalPolicy, TakesNewMatricesForLongerEachTimeThatAnOldOneFailsAgain) {
  RenewalPolicy policy(kCost);
  policy.note(3, true);  // the first matrix
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(new_matrices(policy), 0);
    fail(policy);
  }
  for (const int expected : {4, 8, 16, 32, 64, 64}) {
    EXPECT_EQ(new_matrices(policy), expected);
    fail(policy);
  }
  EXPECT_EQ(new_matrices(policy), 64);
  policy.note(3, false);  // an old matrix converged: the count starts again
  for (int k = 0; k < 4; ++k) fail(policy);
  EXPECT_EQ(new_matrices(policy), 4);
}

TEST(RenewalPolicy, DoesNotTakeRestartsForFailures) {
  RenewalPolicy policy(kCost);
  for (int solve = 0; solve < 20; ++solve) {
    policy.restart();
    fail(policy);
    EXPECT_FALSE(policy.is_due()) << solve;
  }
}

}  // namespace
}  // namespace orthodyn::renewal_policy_test
