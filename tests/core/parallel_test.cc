#include "lib/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace orthodyn::parallel_test {
namespace {

class Parallel : public testing::TestWithParam<int> {
 protected:
  Parallel() { set_threads(GetParam()); }
  ~Parallel() override { set_threads(1); }
};

TEST_P(Parallel, DoesEachPartOnce) {
  EXPECT_EQ(threads(), GetParam());
  for (const int n : {0, 1, 2, 1000}) {
    std::vector<int> done(static_cast<std::size_t>(n), 0);
    parallel_for(n, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(done, std::vector<int>(static_cast<std::size_t>(n), 1));
  }
}

TEST_P(Parallel, ThrowsWhatOnePartThrew) {
  EXPECT_THROW(parallel_for(100, [](int i) { if (i == 42) throw std::range_error("42"); }), std::range_error);
  std::atomic<int> count = 0;
  parallel_for(100, [&](int) { ++count; });
  EXPECT_EQ(count, 100);
}

INSTANTIATE_TEST_SUITE_P(Threads, Parallel, testing::Values(1, 2, 5));

TEST(OneThread, GoesInOrder) {
  std::vector<int> order;
  parallel_for(5, [&](int i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector{0, 1, 2, 3, 4}));
  EXPECT_GE(available_threads(), 1);
}

}  // namespace
}  // namespace orthodyn::parallel_test
