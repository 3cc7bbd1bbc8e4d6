// Numbers printed with as many digits as their error allows.
#include <gtest/gtest.h>

#include <limits>

#include "lib/core/number_format.h"

namespace orthodyn::digits_test {
namespace {

TEST(KnownDigits, AreThoseThatTheErrorDoesNotTouchAndOneMore) {
  EXPECT_EQ(known_digits(324.4871, 0.33), "320");
  EXPECT_EQ(known_digits(324.4871, 0.02), "324");
  EXPECT_EQ(known_digits(324.4871, 1e-3), "324.5");
  EXPECT_EQ(known_digits(-0.0123456, 1e-3), "-0.01235");
  EXPECT_EQ(known_digits(324.4871, -1e-3), "324.5");
  EXPECT_EQ(known_digits(324.4871, 5), "320");  // at least two digits
}

TEST(KnownDigits, AreSevenWhereNoErrorIsTold) {
  EXPECT_EQ(known_digits(324.487123, std::numeric_limits<double>::quiet_NaN()), "324.4871");
  EXPECT_EQ(known_digits(324.487123, 0), "324.4871");
  EXPECT_EQ(known_digits(0, 0.1), "0.0");
}

TEST(KnownDigits, LeaveLargeAndSmallNumbersTheirPowers) {
  EXPECT_EQ(known_digits(1.23456e-9, 0.01), "1.23e-09");
  EXPECT_EQ(known_digits(1.23456e9, 0.01), "1.23e+09");
}

}  // namespace
}  // namespace orthodyn::digits_test
