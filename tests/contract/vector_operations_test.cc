#include "integrators/sundials/vector_operations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "integrators/sundials/handles.h"

namespace orthodyn::vector_operations_test {
namespace {

using namespace sundials;

// Shorter than a block, whole blocks, and blocks with a remainder.
constexpr int kLengths[] = {1, 31, 32, 33, 64, 100};

class VectorOperations : public testing::TestWithParam<int> {
 protected:
  OwnedVector vector_of(const Vector& values) const {
    OwnedVector v = make_vector(values.size(), context_);
    view(v.get()) = values;
    return v;
  }
  static void expect_equal(N_Vector v, const Vector& expected) {
    for (Eigen::Index i = 0; i < expected.size(); ++i) EXPECT_NEAR(view(v)[i], expected[i], 1e-14) << i;
  }

  Context context_;
  const Eigen::Index n_ = GetParam();
  const Vector x_ = Vector::LinSpaced(n_, -1.3, 2.1), y_ = Vector::LinSpaced(n_, 5.7, 0.4);
};

TEST_P(VectorOperations, GiveWhatTheirNamesSay) {
  const OwnedVector x = vector_of(x_), y = vector_of(y_), z = make_vector(n_, context_);
  N_VLinearSum(0.3, x.get(), -2, y.get(), z.get());
  expect_equal(z.get(), 0.3 * x_ - 2 * y_);
  N_VScale(-7, x.get(), z.get());
  expect_equal(z.get(), -7 * x_);
  N_VConst(4.5, z.get());
  expect_equal(z.get(), Vector::Constant(n_, 4.5));
  EXPECT_NEAR(N_VDotProd(x.get(), y.get()), x_.dot(y_), 1e-14 * x_.norm() * y_.norm());
  EXPECT_NEAR(N_VWrmsNorm(x.get(), y.get()), x_.cwiseProduct(y_).norm() / std::sqrt(n_), 1e-14 * x_.norm() * y_.norm());
}

TEST_P(VectorOperations, MayWriteToWhatTheyRead) {
  const OwnedVector x = vector_of(x_), y = vector_of(y_);
  N_VLinearSum(2, x.get(), 1, y.get(), x.get());
  expect_equal(x.get(), 2 * x_ + y_);
  N_VLinearSum(-1, x.get(), 1, y.get(), y.get());
  expect_equal(y.get(), -2 * x_);
  N_VLinearSum(1, x.get(), 3, x.get(), x.get());
  expect_equal(x.get(), 4 * (2 * x_ + y_));
  N_VScale(0.5, y.get(), y.get());
  expect_equal(y.get(), -x_);
}

TEST_P(VectorOperations, CombineSeveralAtOnce) {
  const OwnedVector x = vector_of(x_), y = vector_of(y_), z = vector_of(x_ + y_);
  double weights[] = {1, -0.25, 3};
  N_Vector three[] = {x.get(), y.get(), z.get()};
  ASSERT_EQ(N_VLinearCombination(3, weights, three, x.get()), 0);
  const Vector combined = x_ - 0.25 * y_ + 3 * (x_ + y_);
  for (Eigen::Index i = 0; i < n_; ++i) EXPECT_NEAR(view(x.get())[i], combined[i], 1e-14 * combined.norm());
  ASSERT_EQ(N_VLinearCombination(2, weights, three + 1, z.get()), 0);  // overwriting the last one
  const Vector pair = y_ - 0.25 * (x_ + y_);
  for (Eigen::Index i = 0; i < n_; ++i) EXPECT_NEAR(view(z.get())[i], pair[i], 1e-14 * combined.norm());
  view(z.get()) = x_ + y_;

  N_Vector sums[] = {y.get(), z.get()};
  const Vector shared = view(x.get());
  ASSERT_EQ(N_VScaleAddMulti(2, weights, x.get(), sums, sums), 0);
  for (Eigen::Index i = 0; i < n_; ++i) {
    EXPECT_NEAR(view(y.get())[i], shared[i] + y_[i], 1e-14 * combined.norm());
    EXPECT_NEAR(view(z.get())[i], -0.25 * shared[i] + x_[i] + y_[i], 1e-14 * combined.norm());
  }
}

// Used by error tests.
TEST_P(VectorOperations, NormsTellOfEntriesThatAreNoNumbers) {
  const OwnedVector w = vector_of(Vector::Ones(n_));
  for (Eigen::Index i = 0; i < n_; ++i) {
    Vector broken = x_;
    broken[i] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(N_VWrmsNorm(vector_of(broken).get(), w.get()))) << i;
  }
}

TEST_P(VectorOperations, DifferencesOfEqualsAreZero) {
  const OwnedVector x = vector_of(x_), y = vector_of(x_);
  N_VLinearSum(1 / 3.0, x.get(), -1 / 3.0, y.get(), x.get());
  EXPECT_EQ(view(x.get()).norm(), 0);
}

// A run repeated at another memory address takes the same steps.
TEST_P(VectorOperations, DoNotDependOnAddresses) {
  Vector room(2 * n_ + 16);
  const auto results_at = [&](Eigen::Index begin) {
    room.segment(begin, n_) = x_;
    room.segment(n_ + 8, n_) = y_;
    const auto at = [&](Eigen::Index place) {
      OwnedVector v(N_VMake_Serial(static_cast<sunindextype>(n_), room.data() + place, context_));
      use_fast_operations(v.get());
      return v;
    };
    const OwnedVector x = at(begin), y = at(n_ + 8), z = make_vector(n_, context_);
    N_VLinearSum(1 / 3.0, x.get(), 1 / 7.0, y.get(), x.get());
    double weights[] = {1 / 3.0, 1 / 7.0};
    N_Vector both[] = {x.get(), y.get()};
    N_VLinearCombination(2, weights, both, z.get());
    N_VScaleAddMulti(1, weights, y.get(), both, both);
    Vector results(2 * n_ + 2);
    results << view(x.get()), view(z.get()), N_VWrmsNorm(x.get(), y.get()), N_VDotProd(x.get(), y.get());
    return results;
  };
  const Vector first = results_at(0);
  for (Eigen::Index begin = 1; begin < 8; ++begin) EXPECT_EQ(results_at(begin), first) << begin;
}

TEST_P(VectorOperations, AreThoseOfCopies) {
  const OwnedVector x = vector_of(x_), copy(N_VClone(x.get()));
  EXPECT_NE(x->ops->nvwrmsnorm, N_VWrmsNorm_Serial);
  EXPECT_EQ(copy->ops->nvwrmsnorm, x->ops->nvwrmsnorm);
  ASSERT_TRUE(copy->ops->nvlinearcombination);
  double one[] = {1};
  N_Vector source[] = {x.get()};
  ASSERT_EQ(N_VLinearCombination(1, one, source, copy.get()), 0);
  expect_equal(copy.get(), x_);
}

INSTANTIATE_TEST_SUITE_P(Lengths, VectorOperations, testing::ValuesIn(kLengths));

}  // namespace
}  // namespace orthodyn::vector_operations_test
