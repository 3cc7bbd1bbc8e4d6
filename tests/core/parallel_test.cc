#include "lib/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace orthodyn::parallel_test {
namespace {

class Parallel : public testing::TestWithParam<int> {
 protected:
  LoopThreads threads_{GetParam()};
};

TEST_P(Parallel, DoesEachPartOnce) {
  EXPECT_EQ(loop_threads(), GetParam());
  for (const int n : {0, 1, 2, 1000}) {
    std::vector<int> done(static_cast<std::size_t>(n), 0);
    parallel_for(n, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(done, std::vector<int>(static_cast<std::size_t>(n), 1));
  }
}

TEST_P(Parallel, ThrowsWhatTheFirstPartThrew) {
  for (int k = 0; k < 20; ++k) try {
      parallel_for(100, [](int i) {
        if (i >= 42) throw std::range_error(std::to_string(i));
      });
      FAIL();
    } catch (const std::range_error& e) {
      EXPECT_STREQ(e.what(), "42");
    }
  std::atomic<int> count = 0;
  parallel_for(100, [&](int) { ++count; });
  EXPECT_EQ(count, 100);
}

INSTANTIATE_TEST_SUITE_P(Threads, Parallel, testing::Values(1, 2, 5));

TEST(LoopThreads, AreThoseOfTheThreadThatMadeThem) {
  const LoopThreads outer(3);
  {
    const LoopThreads inner(1);
    EXPECT_EQ(loop_threads(), 1);
  }
  EXPECT_EQ(loop_threads(), 3);
  std::thread other([] {
    EXPECT_EQ(loop_threads(), 1);
    for (int n = 1; n < 20; ++n) {  // concurrently with the loops of the main thread
      const LoopThreads own(1 + n % 3);
      std::atomic<int> count = 0;
      parallel_for(50, [&](int) { ++count; });
      EXPECT_EQ(count, 50);
    }
  });
  std::atomic<int> count = 0;
  for (int k = 0; k < 200; ++k) parallel_for(50, [&](int) { ++count; });
  other.join();
  EXPECT_EQ(count, 10'000);
}

TEST(OneThread, GoesInOrder) {
  std::vector<int> order;
  parallel_for(5, [&](int i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector{0, 1, 2, 3, 4}));
  EXPECT_GE(available_threads(), 1);
}

}  // namespace
}  // namespace orthodyn::parallel_test
