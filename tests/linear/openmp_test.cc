// OpenMP loops of libraries run on the calling thread only while a SerialOpenMp exists, and in parallel afterwards.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "lib/linear/blas.h"
#include "lib/linear/solver.h"

namespace orthodyn::openmp_test {
namespace {

// omp_get_max_active_levels() of the OpenMP library that CHOLMOD loads: the number of nested loops that may run in
// parallel. Null if no OpenMP is loaded.
using Levels = int (*)();
Levels levels() {
  solver_registry();
  return reinterpret_cast<Levels>(dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"));
}

class OpenMp : public testing::Test {
 protected:
  void SetUp() override {
    if (!levels()) GTEST_SKIP() << "no OpenMP is loaded";
  }
};

TEST_F(OpenMp, HasNoParallelLevelsWithinAndTheFormerOnesAfterwards) {
  const int before = levels()();
  ASSERT_GT(before, 0);
  {
    const SerialOpenMp outer;
    EXPECT_EQ(levels()(), 0);
    {
      const SerialOpenMp inner;
      EXPECT_EQ(levels()(), 0);
    }
    EXPECT_EQ(levels()(), 0);
  }
  EXPECT_EQ(levels()(), before);
}

TEST_F(OpenMp, IsParallelAgainAfterAnException) {
  const int before = levels()();
  ASSERT_GT(before, 0);
  EXPECT_THROW(
      {
        const SerialOpenMp serial;
        throw std::runtime_error("a factorisation that does not fit");
      },
      std::runtime_error);
  EXPECT_EQ(levels()(), before);
}

}  // namespace
}  // namespace orthodyn::openmp_test
