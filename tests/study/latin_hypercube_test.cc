#include "lib/study/latin_hypercube.h"

#include <gtest/gtest.h>

#include <set>

namespace orthodyn {
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

}  // namespace
}  // namespace orthodyn
