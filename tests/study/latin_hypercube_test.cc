#include "lib/study/sweep/latin_hypercube.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>

namespace orthodyn::latin_hypercube_test {
namespace {

TEST(LatinHypercube, HasOnePointInEveryStratumOfEveryDimension) {
  const int n = 37, d = 4;
  const auto points = latin_hypercube(n, d, 5);
  ASSERT_EQ(points.size(), 37u);
  for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
    std::set<int> strata;
    for (const auto& point : points) strata.insert(static_cast<int>(point[k] * n));
    EXPECT_EQ(strata.size(), 37u);
    EXPECT_EQ(*strata.begin(), 0);
    EXPECT_EQ(*strata.rbegin(), n - 1);
  }
}

TEST(LatinHypercube, IsTheSameForASeedAndAnotherForAnother) {
  EXPECT_EQ(latin_hypercube(20, 3, 1), latin_hypercube(20, 3, 1));
  EXPECT_NE(latin_hypercube(20, 3, 1), latin_hypercube(20, 3, 2));
}

// The C++ standard ([rand.predef]) defines the 10000th number of the default seed 5489. One point uses one number per
// dimension.
TEST(LatinHypercube, DrawsFromTheGeneratorOfTheStandard) {
  const auto points = latin_hypercube(1, 10000, 5489);
  EXPECT_EQ(points[0][9999], static_cast<double>(std::uint64_t{9981545732273789042u} >> 11) * 0x1p-53);
}

TEST(LatinHypercube, StaysBelowOneAtTheEndOfTheLastStratum) {
  const double u = std::nextafter(1.0, 0.0);
  for (const std::size_t n : {1u, 2u, 3u, 7u, 50u, 1000000u}) {
    EXPECT_LT(position_in(n - 1, u, n), 1) << n;
    EXPECT_GE(position_in(n - 1, u, n) * static_cast<double>(n), static_cast<double>(n - 1)) << n;
    EXPECT_EQ(position_in(0, 0, n), 0) << n;
  }
}

}  // namespace
}  // namespace orthodyn::latin_hypercube_test
