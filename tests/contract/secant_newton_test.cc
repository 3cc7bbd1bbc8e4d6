#include "integrators/sundials/secant_newton.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace orthodyn::secant_newton_test {
namespace {

using namespace sundials;

// F(x) = D (x - 1) with diagonal D, and the unit matrix instead of its derivative.
struct Problem {
  Vector stretch;
  int solves = 0;

  static int system(N_Vector x, N_Vector F, void* me) {
    const auto& stretch = static_cast<Problem*>(me)->stretch;
    view(F) = stretch.cwiseProduct(view(x) - Vector::Ones(stretch.size()));
    return 0;
  }
  static int solve(N_Vector, void* me) {
    ++static_cast<Problem*>(me)->solves;
    return 0;
  }

  // Iterates from zero to an estimated error below 1e-12; returns SUNDIALS' flag.
  int solve_from_zero(SUNNonlinearSolver solver, SUNContext context, Vector* x) {
    const OwnedVector y0 = make_vector(stretch.size(), context), y = make_vector(stretch.size(), context),
                      weights = make_vector(stretch.size(), context);
    view(weights.get()).setLinSpaced(0.5, 2);
    SUNNonlinSolSetSysFn(solver, system);
    SUNNonlinSolSetLSolveFn(solver, solve);
    SUNNonlinSolSetConvTestFn(solver, nullptr, nullptr);  // it has its own
    SUNNonlinSolSetMaxIters(solver, 100);
    SUNNonlinSolInitialize(solver);
    solves = 0;
    const int flag = SUNNonlinSolSolve(solver, y0.get(), y.get(), weights.get(), 1e-12, 0, this);
    if (x) *x = view(y.get());
    return flag;
  }
  Vector solution(SUNNonlinearSolver solver, SUNContext context) {
    Vector x;
    EXPECT_EQ(solve_from_zero(solver, context, &x), 0);
    return x;
  }
};

// A matrix of another gamma: stiff and soft directions have one wrong factor each. Two secants determine two factors,
// so the third correction is exact and the fourth is zero. Without secants each step reduces the error by 0.6: 55 steps
// to 1e-12.
TEST(SecantNewton, SolvesAtOnceWhatIsOffByTwoFactors) {
  const Context context;
  Problem problem{(Vector(6) << 0.5, 0.5, 1.6, 0.5, 1.6, 1.6).finished()};
  const OwnedVector y = make_vector(6, context);
  CallbackContext callbacks;
  const SecantNewton newton(y.get(), context, callbacks);
  for (const char* time : {"first", "second"}) {  // no secant of the first solve remains
    SCOPED_TRACE(time);
    EXPECT_LE((problem.solution(newton.get(), context) - Vector::Ones(6)).norm(), 1e-12);
    EXPECT_EQ(problem.solves, 4);
  }
}

TEST(SecantNewton, ConvergesWithManyFactors) {
  const Context context;
  Problem problem{Vector::LinSpaced(40, 0.4, 1.6)};
  const OwnedVector y = make_vector(40, context);
  CallbackContext callbacks;
  const SecantNewton newton(y.get(), context, callbacks);
  EXPECT_LE((problem.solution(newton.get(), context) - Vector::Ones(40)).norm(), 1e-10);
  EXPECT_LT(problem.solves, 55) << "as many as without secants";
}

// All secants are parallel: the second adds no information.
TEST(SecantNewton, SolvesAtOnceWhatIsOffByOneFactor) {
  const Context context;
  Problem problem{Vector::Constant(6, 1.6)};
  const OwnedVector y = make_vector(6, context);
  CallbackContext callbacks;
  const SecantNewton newton(y.get(), context, callbacks);
  EXPECT_LE((problem.solution(newton.get(), context) - Vector::Ones(6)).norm(), 1e-12);
  EXPECT_EQ(problem.solves, 3);
}

TEST(SecantNewton, ForgetsASolveThatWentWrong) {
  const Context context;
  const OwnedVector y = make_vector(6, context);
  CallbackContext callbacks;
  const SecantNewton newton(y.get(), context, callbacks);
  Problem wrong{Vector::Constant(6, std::numeric_limits<double>::quiet_NaN())};
  EXPECT_NE(wrong.solve_from_zero(newton.get(), context, nullptr), 0);
  Problem problem{Vector::Constant(6, 1.6)};
  EXPECT_LE((problem.solution(newton.get(), context) - Vector::Ones(6)).norm(), 1e-12);
}

// The second correction is zero.
// For example a lost rank: SUNDIALS gets an error flag, and the exception is rethrown to its caller.
TEST(SecantNewton, PassesNoExceptionThroughSundials) {
  struct Lost : Ranks {
    int rank() const override { return 0; }
    int size() const override { return 2; }
    void sum(std::span<double>) const override { throw std::runtime_error("lost"); }
    void max(std::span<double>) const override {}
    long sum_before(long) const override { return 0; }
    void broadcast(std::span<double>) const override {}
    std::vector<double> gather(std::span<const double>) const override { return {}; }
    void scatter(std::span<const double>, std::span<double>) const override {}
    std::vector<int> partition(const CellGraph&) const override { return {}; }
    std::unique_ptr<NodeExchange> exchange(int, const std::vector<RemoteNode>&) const override { return nullptr; }
    bool barrier_within(double) const override { return false; }
    void abort(int) const override { std::abort(); }
  } const lost;
  const Context context;
  Problem problem{Vector::Constant(6, 0.5)};
  const OwnedVector y = make_vector(6, context);
  CallbackContext callbacks;
  const SecantNewton newton(y.get(), context, callbacks, VectorSpace(&lost, 12));
  EXPECT_LT(problem.solve_from_zero(newton.get(), context, nullptr), 0);
  ASSERT_TRUE(callbacks.failure);
  EXPECT_THROW(std::rethrow_exception(callbacks.failure), std::runtime_error);
}

TEST(SecantNewton, TakesAnExactMatrix) {
  const Context context;
  Problem problem{Vector::Ones(6)};
  const OwnedVector y = make_vector(6, context);
  CallbackContext callbacks;
  const SecantNewton newton(y.get(), context, callbacks);
  EXPECT_EQ(problem.solution(newton.get(), context), Vector(Vector::Ones(6)));
  EXPECT_EQ(problem.solves, 2);
}

}  // namespace
}  // namespace orthodyn::secant_newton_test
