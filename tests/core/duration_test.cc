// Durations in words.
#include <gtest/gtest.h>

#include "lib/core/number_format.h"

namespace orthodyn::duration_test {
namespace {

TEST(DurationText, CarriesFromSecondsToMinutesAndHours) {
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 0 s");
  EXPECT_EQ(duration_text(119.7), "2 min 0 s");
  EXPECT_EQ(duration_text(125), "2 min 5 s");
  EXPECT_EQ(duration_text(3599.6), "1.0 h");
  EXPECT_EQ(duration_text(5400), "1.5 h");
}

}  // namespace
}  // namespace orthodyn::duration_test
