// Newton's method for one implicit stage: solutions, and updates of the matrix.
#include "integrators/native/stage_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/contract/constrained_models.h"
#include "tests/contract/models.h"

namespace orthodyn::stage_solver_test {
namespace {

// A stage solver with a fixed step at a model's initial state.
class Stages {
 public:
  explicit Stages(const SmallModel& model, NewtonKind kind = NewtonKind::lazy)
      : model_(model),
        solver_(model, options(kind), ScaledNorm(1e-10, {1, 1}), statistics_),
        x_(Vector::Zero(model.num_dofs())),
        q_(model.num_dofs()),
        v_(model.num_dofs()) {}

  // The stage of the trapezoidal rule with w_d = h / 2, from a guess of zero.
  bool solve(double w_d) {
    const State start = model_.initial();
    stage_ = {w_d, start.q + w_d * start.v, start.v, w_d, w_d * w_d};
    x_.setZero();
    solver_.begin_step();
    return solver_.solve(stage_, x_, q_, v_);
  }

  // M x - f(t, q, v) at the solution, relative to f at the start of the iteration.
  double residual() const {
    Vector f(x_.size()), first(x_.size()), mx(x_.size());
    model_.force(stage_.t, q_, v_, f);
    model_.force(stage_.t, stage_.q, stage_.v, first);
    model_.multiply_mass(x_, mx);
    return (mx - f).norm() / first.norm();
  }

  // q and v from x.
  double mismatch() const {
    return (q_ - stage_.q - stage_.w_k * x_).norm() + (v_ - stage_.v - stage_.w_d * x_).norm();
  }

  StageSolver& solver() { return solver_; }
  const Statistics& statistics() const { return statistics_; }

 private:
  static NewtonOptions options(NewtonKind kind) {
    NewtonOptions options;
    options.newton = kind;
    options.step = 1;
    options.nonlinear_coefficient = 1e-2;
    options.max_newton_iterations = 20;
    return options;
  }

  const SmallModel& model_;
  Statistics statistics_;
  StageSolver solver_;
  StageSolver::Stage stage_;
  Vector x_, q_, v_;
};

TEST(StageSolver, FindsTheAccelerationOfALinearModelInTwoIterations) {
  const auto model = chain(true);
  Stages stages(model);
  ASSERT_TRUE(stages.solve(0.1));
  EXPECT_LE(stages.residual(), 1e-11);
  EXPECT_LE(stages.mismatch(), 1e-13);
  EXPECT_LE(stages.statistics().newton_iterations, 2);  // the second confirms convergence
}

TEST(StageSolver, FindsTheAccelerationOfANonlinearModel) {
  const auto model = pendulum();
  for (const auto kind : {NewtonKind::lazy, NewtonKind::modified, NewtonKind::full}) {
    Stages stages(model, kind);
    ASSERT_TRUE(stages.solve(0.01));
    EXPECT_LE(stages.residual(), 1e-8);
    EXPECT_LE(stages.mismatch(), 1e-13);
  }
}

TEST(StageSolver, KeepsItsFactorWhileTheWeightsMoveLittle) {
  const auto model = chain(false);
  Stages stages(model);
  ASSERT_TRUE(stages.solve(0.1));
  ASSERT_TRUE(stages.solve(0.1 * std::sqrt(1.2)));  // w_k is 20 % larger
  EXPECT_LE(stages.residual(), 1e-10);
  EXPECT_EQ(stages.statistics().factorization.count, 1);
  ASSERT_TRUE(stages.solve(0.1 * std::sqrt(1.3)));
  EXPECT_EQ(stages.statistics().factorization.count, 2);
  EXPECT_EQ(stages.statistics().tangent.count, 1);  // K and D of a linear model are constant
}

TEST(StageSolver, MakesItsTangentAsOftenAsItsKindSays) {
  const auto model = pendulum();
  Stages lazy(model, NewtonKind::lazy), modified(model, NewtonKind::modified), full(model, NewtonKind::full);
  for (Stages* stages : {&lazy, &modified, &full})
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(stages->solve(0.001));
  EXPECT_EQ(lazy.statistics().tangent.count, 1);
  EXPECT_EQ(modified.statistics().tangent.count, 3);
  EXPECT_EQ(full.statistics().tangent.count, full.statistics().newton_iterations);
}

TEST(StageSolver, LeavesAForceThatCannotBeEvaluatedToItsCaller) {
  const Disturbed<LinearModel> model(harmonic_oscillator(), [](long, double, VectorRef f) { f[0] = NAN; });
  EXPECT_THROW(Stages(model).solve(0.1), RecoverableError);
}

// (I - w J) with J = [0, I; -M^-1 K, -M^-1 D], for w_k = w_d^2 exactly.
TEST(StageSolver, FiltersByTheInverseOfTheIterationMatrix) {
  const auto model = damped_oscillator();  // M = 2, K = 18, D = 2.4
  const double w = 0.2;
  Stages stages(model);
  ASSERT_TRUE(stages.solve(w));
  const Vector given_q = Vector::Constant(1, 0.7), given_v = Vector::Constant(1, -1.3);
  Vector e_q = given_q, e_v = given_v;
  stages.solver().filter(e_q, e_v);
  EXPECT_NEAR(e_q[0] - w * e_v[0], given_q[0], 1e-13);
  EXPECT_NEAR(e_v[0] + w * (18 * e_q[0] + 2.4 * e_v[0]) / 2, given_v[0], 1e-13);
}

TEST(StageSolver, RemovesFromErrorsWhatViolatesTheConstraints) {
  const SphericalPendulum model;
  const double w = 0.01;
  Stages stages(model);
  ASSERT_TRUE(stages.solve(w));
  Vector e_q{{0.3, -0.5, 0.4}}, e_v{{0.2, 0.7, -0.6}};
  const Vector rod = (model.initial().q + w * model.initial().v).normalized();  // where G was computed
  const Vector along_q = e_q - rod.dot(e_q) * rod, along_v = e_v - rod.dot(e_v) * rod;
  stages.solver().filter(e_q, e_v);
  EXPECT_LE((e_v - along_v).norm(), 1e-13);  // without stiffness, nothing is damped
  EXPECT_LE((e_q - along_q - w * along_v).norm(), 1e-13);
}

}  // namespace
}  // namespace orthodyn::stage_solver_test
