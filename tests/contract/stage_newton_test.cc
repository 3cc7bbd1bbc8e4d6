#include "integrators/sundials/stage_newton.h"

#include <gtest/gtest.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

namespace orthodyn::stage_newton_test {
namespace {

using namespace sundials;

// F(x) = x - 1 in one unknown. Each correction is the residual times 1 - `ratio`, so that the error shrinks by `ratio`.
class Stages {
 public:
  explicit Stages(double rtol = 1e-3)
      : y_(make_vector(1, context_)),
        newton_(
            y_.get(), context_, [this] { return conditions; }, rtol, 0) {
    SUNNonlinSolSetSysFn(newton_.get(), [](N_Vector x, N_Vector F, void*) {
      view(F)[0] = view(x)[0] - 1;
      return 0;
    });
    SUNNonlinSolSetLSolveFn(newton_.get(), [](N_Vector b, void* me) {
      auto& stages = *static_cast<Stages*>(me);
      ++stages.iterations_;
      view(b)[0] *= 1 - stages.ratio;
      return 0;
    });
    SUNNonlinSolSetMaxIters(newton_.get(), 50);
    newton_.replace_test();
    SUNNonlinSolInitialize(newton_.get());
  }

  // Solves from x = 1 - error to this tolerance. Returns SUNDIALS' flag.
  int solve(double error, double tolerance) {
    const OwnedVector unused = make_vector(1, context_), weights = make_vector(1, context_);
    view(y_.get())[0] = 1 - error;
    view(weights.get())[0] = 1;
    iterations_ = 0;
    return SUNNonlinSolSolve(newton_.get(), unused.get(), y_.get(), weights.get(), tolerance, 0, this);
  }
  int iterations() const { return iterations_; }

  StageNewton::Conditions conditions{1, 0.1};
  double ratio = 0.1;

 private:
  Context context_;
  OwnedVector y_;
  StageNewton newton_;
  int iterations_ = 0;
};

TEST(StageNewton, StopsByTheErrorThatRemains) {
  Stages stages;
  ASSERT_EQ(stages.solve(1, 1.1e-4), 0);
  EXPECT_EQ(stages.iterations(), 4);  // after which the error is 1e-4; the last correction was 9e-4
}

TEST(StageNewton, UsesTheRateOfTheStageBeforeWithTheSameMatrix) {
  Stages stages;
  const auto iterations = [&] {
    EXPECT_EQ(stages.solve(1, 0.5), 0);
    return stages.iterations();
  };
  EXPECT_EQ(iterations(), 2);
  EXPECT_EQ(iterations(), 1);
  stages.conditions.gamma *= 1 + 1e-15;  // by round-off of the times
  EXPECT_EQ(iterations(), 1);
  stages.conditions.gamma *= 1.1;
  EXPECT_EQ(iterations(), 2);
  EXPECT_EQ(iterations(), 1);
  ++stages.conditions.factorizations;
  EXPECT_EQ(iterations(), 2);
}

// With the matrix of a gamma 1.5 times as small, some corrections shrink by 0.2 although those before shrank faster.
TEST(StageNewton, ExpectsNoFasterRateThanAnotherGammaAllows) {
  Stages stages;
  stages.ratio = 1e-4;
  ASSERT_EQ(stages.solve(1, 0.1), 0);
  stages.conditions.gamma *= 1.5;
  ASSERT_EQ(stages.solve(1, 0.1), 0);  // measures the rate
  ASSERT_EQ(stages.solve(1, 0.1), 0);
  EXPECT_EQ(stages.iterations(), 2);
}

TEST(StageNewton, FailsIfCorrectionsGrow) {
  Stages stages;
  stages.ratio = -3;
  EXPECT_EQ(stages.solve(1, 1e-4), SUN_NLS_CONV_RECVR);
  EXPECT_EQ(stages.iterations(), 2);
}

TEST(StageNewton, AcceptsRoundOffThatDoesNotShrink) {
  Stages stages(1e-11);
  stages.ratio = -1;  // corrections of equal size
  EXPECT_EQ(stages.solve(0.25, 1e-3), 0);
  EXPECT_EQ(stages.iterations(), 2);
}

}  // namespace
}  // namespace orthodyn::stage_newton_test
