#include "integrators/sundials/vector_operations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "integrators/sundials/handles.h"

namespace orthodyn::vector_operations_test {
namespace {

using namespace sundials;

// Shorter than a block, blocks without a rest, and both.
constexpr int kLengths[] = {1, 31, 32, 33, 64, 100};

class VectorOperations : public testing::TestWithParam<int> {
 protected:
  OwnedVector vector_of(const Vector& values) const {
    OwnedVector v = make_vector(values.size(), context_);
    view(v.get()) = values;
    return v;
  }
  static void expect_equal(N_Vector v, const Vector& expected) {
    for (Eigen::Index i = 0; i < expected.size(); ++i) EXPECT_DOUBLE_EQ(view(v)[i], expected[i]) << i;
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
  N_VLinearSum(1, x.get(), 3, x.get(), x.get());
  expect_equal(x.get(), 4 * (2 * x_ + y_));
  N_VScale(0.5, y.get(), y.get());
  expect_equal(y.get(), 0.5 * y_);
}

TEST_P(VectorOperations, CombineSeveralAtOnce) {
  const OwnedVector x = vector_of(x_), y = vector_of(y_), z = vector_of(x_ + y_);
  double weights[] = {1, -0.25, 3};
  N_Vector three[] = {x.get(), y.get(), z.get()};
  ASSERT_EQ(N_VLinearCombination(3, weights, three, x.get()), 0);
  const Vector combined = x_ - 0.25 * y_ + 3 * (x_ + y_);
  for (Eigen::Index i = 0; i < n_; ++i) EXPECT_NEAR(view(x.get())[i], combined[i], 1e-14 * combined.norm());

  N_Vector sums[] = {y.get(), z.get()};
  const Vector shared = view(x.get());
  ASSERT_EQ(N_VScaleAddMulti(2, weights, x.get(), sums, sums), 0);
  for (Eigen::Index i = 0; i < n_; ++i) {
    EXPECT_NEAR(view(y.get())[i], shared[i] + y_[i], 1e-14 * combined.norm());
    EXPECT_NEAR(view(z.get())[i], -0.25 * shared[i] + x_[i] + y_[i], 1e-14 * combined.norm());
  }
}

// Error tests go by it.
TEST_P(VectorOperations, NormsTellOfEntriesThatAreNoNumbers) {
  const OwnedVector w = vector_of(Vector::Ones(n_));
  for (Eigen::Index i = 0; i < n_; ++i) {
    Vector broken = x_;
    broken[i] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(N_VWrmsNorm(vector_of(broken).get(), w.get()))) << i;
  }
}

// A run repeated in another place of the memory takes the same steps.
TEST_P(VectorOperations, DoNotDependOnAddresses) {
  Vector room(n_ + 8);
  const auto norm_at = [&](Eigen::Index begin) {
    room.segment(begin, n_) = x_;
    const OwnedVector x(N_VMake_Serial(static_cast<sunindextype>(n_), room.data() + begin, context_));
    use_fast_operations(x.get());
    N_VLinearSum(1 / 3.0, x.get(), 1 / 7.0, x.get(), x.get());
    return N_VWrmsNorm(x.get(), x.get());
  };
  const double first = norm_at(0);
  for (Eigen::Index begin = 1; begin < 8; ++begin) EXPECT_EQ(norm_at(begin), first) << begin;
}

TEST_P(VectorOperations, AreThoseOfCopies) {
  const OwnedVector x = vector_of(x_), copy(N_VClone(x.get()));
  EXPECT_EQ(copy->ops->nvwrmsnorm, x->ops->nvwrmsnorm);
  EXPECT_EQ(copy->ops->nvlinearcombination, x->ops->nvlinearcombination);
}

INSTANTIATE_TEST_SUITE_P(Lengths, VectorOperations, testing::ValuesIn(kLengths));

}  // namespace
}  // namespace orthodyn::vector_operations_test
