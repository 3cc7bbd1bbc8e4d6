#include "integrators/sundials/setup_schedule.h"

#include <gtest/gtest.h>

namespace orthodyn::sundials::setup_schedule_test {
namespace {

// Number of steps with a new matrix before an old one is tried again.
int new_steps(SetupSchedule& schedule) {
  int steps = 0;
  for (; schedule.interval() == 1; ++steps) schedule.note(true);
  return steps;
}

TEST(SetupSchedule, TakesOldMatricesWhereTheyServeNowAndThen) {
  SetupSchedule schedule;
  for (int step = 0; step < 100; ++step) {
    EXPECT_EQ(schedule.interval(), 20) << step;
    schedule.note(step % 4 != 0);  // three failures in a row
  }
}

TEST(SetupSchedule, TakesNewOnesForLongerEachTimeThatAnOldOneFailsAgain) {
  SetupSchedule schedule;
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(new_steps(schedule), 0);
    schedule.note(true);
  }
  for (const int expected : {4, 8, 16, 32, 64, 64}) {
    EXPECT_EQ(new_steps(schedule), expected);
    schedule.note(true);
  }
  EXPECT_EQ(new_steps(schedule), 64);
  schedule.note(false);  // an old matrix converged: the count starts again
  for (int k = 0; k < 4; ++k) schedule.note(true);
  EXPECT_EQ(new_steps(schedule), 4);
}

}  // namespace
}  // namespace orthodyn::sundials::setup_schedule_test
