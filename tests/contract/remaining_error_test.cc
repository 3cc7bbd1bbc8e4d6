#include "integrators/remaining_error.h"

#include <gtest/gtest.h>

namespace orthodyn::remaining_error_test {
namespace {

TEST(RemainingError, IsTheSumOfTheCorrectionsToCome) {
  RemainingError remaining(false);
  EXPECT_EQ(remaining.after(2, 0), 2);  // nothing is known: as large as the correction
  remaining.note(0.25);
  EXPECT_DOUBLE_EQ(remaining.after(3, 0), 1);  // 3 (1/4 + 1/16 + ...)
  EXPECT_DOUBLE_EQ(remaining.after(3, 0.5), 1.5);
  remaining.restart();
  EXPECT_EQ(remaining.after(2, 0), 2);
}

TEST(RemainingError, IsNotSmallerForTheFirstCorrectionOfAnotherEquation) {
  for (const double ratio : {0.0, 1e-6, 0.1, 0.49, 0.5, 0.9, 0.999}) {
    RemainingError remaining(false);
    remaining.note(ratio);
    for (int equation = 0; equation < 3; ++equation) {
      const double before = remaining.after(1, 0);
      remaining.begin();
      EXPECT_GE(remaining.after(1, 0), before) << ratio;
    }
    EXPECT_GE(remaining.after(1, 0), 1e-3) << ratio;
  }
}

TEST(RemainingError, IsTheSameInAllEquationsOfALinearModel) {
  RemainingError remaining(true);
  remaining.note(1e-6);
  const double before = remaining.after(1, 0);
  remaining.begin();
  EXPECT_EQ(remaining.after(1, 0), before);
}

}  // namespace
}  // namespace orthodyn::remaining_error_test
