// The Newton matrix of implicit schemes: its solutions and its fallback.
#include "integrators/newton_matrix.h"

#include <gtest/gtest.h>

#include "lib/core/errors.h"
#include "tests/contract/models.h"

namespace orthodyn::newton_matrix_test {
namespace {

Vector product(const Model& model, const Weights& weights, TangentKind kind, const State& at, const Vector& x) {
  Linearization linearization;
  model.linearize(at.t, at.q, at.v, kind, linearization);
  std::vector<double> values(model.pattern().row.size());
  model.combine(weights, linearization, values.data());
  Vector y(x.size());
  model.pattern().multiply(values.data(), x, y);
  return y;
}

TEST(NewtonMatrix, SolvesWithTheWeightsOfItsLastFactor) {
  const auto model = chain(true);
  const State at = model.initial();
  for (const std::string solver : {"cholesky", "eigen_ldlt", "klu"}) {
    Statistics statistics;
    NewtonMatrix matrix(model, solver, TangentKind::exact, statistics);
    matrix.linearize(at.t, at.q, at.v);
    for (const Weights& weights : {Weights{1, 0.3, 0.09}, Weights{0, 0, 1}}) {
      ASSERT_TRUE(matrix.factor(weights));
      const Vector b = Vector::LinSpaced(model.num_dofs(), -1, 2);
      Vector x(b.size());
      matrix.solve(b, x);
      EXPECT_LE((product(model, weights, TangentKind::exact, at, x) - b).norm(), 1e-12 * b.norm()) << solver;
    }
    EXPECT_EQ(statistics.tangent.count, 1);
    EXPECT_EQ(statistics.factorization.count, 2);
  }
}

TEST(NewtonMatrix, MultipliesByTheStiffness) {
  const auto model = chain(false);
  const State at = model.initial();
  Statistics statistics;
  NewtonMatrix matrix(model, "cholesky", TangentKind::exact, statistics);
  matrix.linearize(at.t, at.q, at.v);
  const Vector x = Vector::LinSpaced(model.num_dofs(), 1, 2);
  Vector y(x.size());
  matrix.multiply_stiffness(x, y);
  EXPECT_LE((y - product(model, {0, 0, 1}, TangentKind::exact, at, x)).norm(), 1e-13 * y.norm());
}

// The transverse stiffness of a compressed column is negative.
TEST(NewtonMatrix, TakesTheGaussNewtonPartWhereTheExactOneIsIndefinite) {
  const auto model = upright_column();
  const State at = model.initial();
  const Weights weights{1, 0, 100};
  Statistics statistics;
  NewtonMatrix matrix(model, "cholesky", TangentKind::exact, statistics);
  matrix.linearize(at.t, at.q, at.v);
  ASSERT_TRUE(matrix.factor(weights));
  EXPECT_EQ(statistics.gauss_newton_fallbacks, 1);
  const Vector b = Vector::Ones(2);
  Vector x(2);
  matrix.solve(b, x);
  EXPECT_LE((product(model, weights, TangentKind::gauss_newton, at, x) - b).norm(), 1e-12);
}

TEST(NewtonMatrix, StaysWithTheGaussNewtonPartForTenSetUps) {
  const auto model = upright_column();
  const State at = model.initial();
  Statistics statistics;
  NewtonMatrix matrix(model, "cholesky", TangentKind::exact, statistics);
  const auto set_up = [&] {
    matrix.linearize(at.t, at.q, at.v);
    ASSERT_TRUE(matrix.factor({1, 0, 100}));
  };
  for (int k = 0; k < 11; ++k) set_up();  // the first one, which falls back, and the ten others
  EXPECT_EQ(statistics.gauss_newton_fallbacks, 1);
  set_up();
  EXPECT_EQ(statistics.gauss_newton_fallbacks, 2);
}

TEST(NewtonMatrix, TakesTheGaussNewtonPartFromTheStartIfTold) {
  const auto model = upright_column();
  const State at = model.initial();
  Statistics statistics;
  NewtonMatrix matrix(model, "cholesky", TangentKind::gauss_newton, statistics);
  matrix.linearize(at.t, at.q, at.v);
  EXPECT_TRUE(matrix.factor({1, 0, 100}));
  EXPECT_EQ(statistics.gauss_newton_fallbacks, 0);
}

TEST(NewtonMatrix, OfAnUnsymmetricTangentNeedsASolverThatTakesIt) {
  const CirculatoryModel model;
  Statistics statistics;
  EXPECT_NO_THROW(NewtonMatrix(model, "klu", TangentKind::exact, statistics));
  try {
    NewtonMatrix(model, "cholesky", TangentKind::exact, statistics);
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_TRUE(e.place().empty());
    EXPECT_NE(e.message().find("use klu"), std::string::npos) << e.message();
  }
}

}  // namespace
}  // namespace orthodyn::newton_matrix_test
