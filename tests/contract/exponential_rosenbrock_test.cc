// The exponential Rosenbrock method and its phi functions.
#include <unsupported/Eigen/MatrixFunctions>

#include "integrators/native/krylov_phi.h"
#include "tests/contract/integrators.h"

namespace orthodyn::exponential_rosenbrock_test {
namespace {

std::unique_ptr<Integrator> exponential(const SmallModel& model, const std::string& keys) {
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{type: exponential_rosenbrock" + keys + "}"));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
}

// phi_k(A) b by its definition, phi_k = A^-1 (phi_{k-1} - 1/(k-1)!).
Vector phi(int k, const Matrix& A, const Vector& b) {
  Matrix value = A.exp();
  double factorial = 1;
  for (int j = 1; j <= k; ++j) {
    value = A.lu().solve((value - Matrix::Identity(A.rows(), A.rows()) / factorial).eval()).eval();
    factorial *= j;
  }
  return value * b;
}

// A stiff first-order system of six oscillators, frequencies 1 to 32, damped.
Matrix oscillators() {
  Matrix J = Matrix::Zero(12, 12);
  for (int k = 0; k < 6; ++k) {
    const double omega = 1 << k;
    J(k, 6 + k) = omega;
    J(6 + k, k) = -omega;
    J(6 + k, 6 + k) = -0.1 * omega;
  }
  return J;
}

TEST(KrylovPhi, AgreesWithTheDefinitionForAnyStepOfOneSpace) {
  const Matrix J = oscillators();
  const Vector b = Vector::LinSpaced(12, 1, 2);
  KrylovPhi space(12, 40);
  space.begin([&](const Eigen::Ref<const Vector>& x, VectorRef y) { y = J * x; }, b);
  Vector out;
  for (const double h : {0.01, 0.5, 0.1})
    for (const int k : {1, 2, 3}) {
      ASSERT_TRUE(space.apply(k, h, 1e-12, out));
      EXPECT_LE((out - phi(k, h * J, b)).norm(), 1e-9 * out.norm()) << h << " " << k;
    }
}

TEST(KrylovPhi, KeepsItsErrorBelowTheToleranceByTheSizeOfTheSpace) {
  const Matrix J = oscillators();
  const Vector b = Vector::LinSpaced(12, 1, 2), exact = phi(1, 0.1 * J, b);
  int before = 0;
  for (const double tolerance : {1e-1, 1e-3, 1e-6}) {
    KrylovPhi space(12, 40);
    space.begin([&](const Eigen::Ref<const Vector>& x, VectorRef y) { y = J * x; }, b);
    Vector out;
    ASSERT_TRUE(space.apply(1, 0.1, tolerance, out));
    EXPECT_LE((out - exact).norm() / std::sqrt(12.0), tolerance);
    EXPECT_GE(space.dimension(), before);
    before = space.dimension();
  }
}

TEST(KrylovPhi, SaysWhenTheLargestSpaceIsTooSmall) {
  const Matrix J = oscillators();
  KrylovPhi space(12, 5);
  space.begin([&](const Eigen::Ref<const Vector>& x, VectorRef y) { y = J * x; }, Vector::LinSpaced(12, 1, 2));
  Vector out;
  EXPECT_FALSE(space.apply(1, 1, 1e-6, out));
  EXPECT_TRUE(space.apply(1, 1e-3, 1e-6, out));
}

TEST(KrylovPhi, OfAnInvariantSpaceIsExact) {
  const Matrix J = oscillators();
  KrylovPhi space(12, 40);
  const Vector b = Vector::Unit(12, 2);
  space.begin([&](const Eigen::Ref<const Vector>& x, VectorRef y) { y = J * x; }, b);
  Vector out;
  ASSERT_TRUE(space.apply(1, 3, 1e-13, out));
  EXPECT_EQ(space.dimension(), 2);
  EXPECT_LE((out - phi(1, 3 * J, b)).norm(), 1e-12);
}

// For any step size, the error is only the tolerance of the Krylov spaces.
TEST(ExponentialRosenbrock, IsExactOnALinearModelInStepsOfAnyLength) {
  for (const auto& model : {damped_oscillator(), chain(false), stiff_pair()}) {
    const auto integrator = exponential(model, fmt::format(", rtol: 1e-9, step: {}", model.end() / 3));
    const State last = integrate(model, *integrator);
    EXPECT_LE(distance(last, model.exact(last.t), model.scales()), 1e-7);
    EXPECT_EQ(integrator->statistics().steps, 3);
  }
}

// dF/dt integrates a load that is linear in time exactly, except for the round-off of its difference quotient.
TEST(ExponentialRosenbrock, IsExactUnderALoadThatIsLinearInTime) {
  const auto model = kinked_oscillator();
  const State last = integrate(model, *exponential(model, ", rtol: 1e-8, step: 0.5"));
  EXPECT_LE(distance(last, model.exact(last.t), model.scales()), 1e-5);
}

TEST(ExponentialRosenbrock, IsOfThirdOrderOnANonlinearModel) {
  const auto model = pendulum();
  const State exact = integrate(model, *exponential(model, ", rtol: 1e-11, step: 0.0002"));
  const std::vector<double> steps = {0.004, 0.003, 0.002, 0.0015};
  std::vector<double> errors;
  for (const double step : steps) {
    const State last = integrate(model, *exponential(model, fmt::format(", rtol: 1e-11, step: {}", step)));
    errors.push_back(distance(last, exact, model.scales()));
  }
  EXPECT_NEAR(slope(steps, errors), 3, 0.4);
}

TEST(ExponentialRosenbrock, ShortensAStepThatNeedsALargerSpace) {
  const auto model = chain(false);
  const auto small = exponential(model, ", rtol: 1e-6, krylov_dimension: 6");
  const auto large = exponential(model, ", rtol: 1e-6");
  const State last = integrate(model, *small);
  integrate(model, *large);
  EXPECT_GT(small->statistics().steps, large->statistics().steps);
  EXPECT_LE(distance(last, model.exact(last.t), model.scales()), 1e-4);
}

TEST(ExponentialRosenbrock, EndsWhereAFixedStepNeedsALargerSpaceWithTheRemedy) {
  const auto model = chain(false);
  try {
    integrate(model, *exponential(model, ", rtol: 1e-6, krylov_dimension: 4, step: 2"));
    FAIL() << "nothing was thrown";
  } catch (const RunError& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find("raise integrator.krylov_dimension or lower integrator.step"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace orthodyn::exponential_rosenbrock_test
