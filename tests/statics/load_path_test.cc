// Forces on a load path, and their derivative by the load factor lambda.
#include "lib/statics/load_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/contract/models.h"

namespace orthodyn::load_path_test {
namespace {

// A model with the force f = e^t - q, which does not know its loads.
class Growing : public SmallModel {
 public:
  Growing() : SmallModel(Matrix::Identity(1, 1)) {}
  void force(double t, const ConstVectorRef& q, const ConstVectorRef&, VectorRef f) const override {
    f[0] = std::exp(t) - q[0];
  }
  State initial() const override { return {0, Vector::Zero(1), Vector::Zero(1)}; }
  double end() const override { return 1; }

 private:
  Matrix stiffness(double, const Vector&, const Vector&, TangentKind) const override { return Matrix::Identity(1, 1); }
};

double rate(const LoadPath& path, double lambda) { return path.rate(lambda, Vector::Constant(1, 0.3))[0]; }

// With t = 2 lambda the exact rate is 2 e^t + 1, where 1 is the force at the start, applied as a dead load. The error
// of second-order differences with the step h = 1e-5 is at most h^2/3 times the third derivative, 8 e^t.
TEST(LoadPath, HasTheRateOfItsForcesAtItsEndsAsInBetween) {
  const Growing model;
  const LoadPath path(model, {0, 2}, Vector::Zero(1));
  for (const double lambda : {0.0, 3e-6, 0.4, 1 - 3e-6, 1.0})
    EXPECT_NEAR(rate(path, lambda), 2 * std::exp(2 * lambda) + 1, 8e-10 * std::exp(2 * lambda)) << lambda;
}

TEST(LoadPath, BeyondItsEndsHasTheRateOfTheNearerOne) {
  const Growing model;
  const LoadPath path(model, {0, 2}, Vector::Zero(1));
  for (const double beyond : {1e-5, 2e-5, 0.1}) {
    EXPECT_EQ(rate(path, 1 + beyond), rate(path, 1)) << beyond;
    EXPECT_EQ(rate(path, -beyond), rate(path, 0)) << beyond;
  }
}

TEST(LoadPath, OfOneTimeHasTheRateOfItsDeadLoads) {
  const Growing model;
  const LoadPath path(model, 1.5, Vector::Zero(1));
  EXPECT_EQ(rate(path, 0.7), std::exp(1.5));
}

}  // namespace
}  // namespace orthodyn::load_path_test
