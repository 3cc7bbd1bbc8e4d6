// Load steps with KINSOL on models whose equilibria are known.
#include "lib/statics/load_stepper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/contract/models.h"

namespace orthodyn::load_stepper_test {
namespace {

// Von Mises' truss: two bars with EA = 1 run from (-1, 0) and (1, 0) to a hinge at the height z = 0.2 - q, which a load
// presses down. A bar of length L, at rest L0, has the force N = EA (L - L0)/L0, so that the load in equilibrium is
// P(z) = 2 EA z (1/L - 1/L0).
class Truss : public SmallModel {
 public:
  explicit Truss(double load) : SmallModel(scalar(1)), load_(load) {}
  static constexpr double kRise = 0.2;
  static double rest_length() { return std::sqrt(1 + kRise * kRise); }
  static double height(const Vector& q) { return kRise - q[0]; }
  static double resistance(double z) { return 2 * z * (1 / std::hypot(1, z) - 1 / rest_length()); }

  // The height at which dP/dz = 0: there L^3 = b^2 L0 with the half span b = 1.
  static double limit_height() { return std::sqrt(std::pow(rest_length(), 2.0 / 3) - 1); }
  static double limit_load() { return resistance(limit_height()); }

  void force(double, const ConstVectorRef& q, const ConstVectorRef&, VectorRef f) const override {
    f[0] = load_ - resistance(kRise - q[0]);
  }
  State initial() const override { return {0, Vector::Zero(1), Vector::Zero(1)}; }
  double end() const override { return 1; }

 private:
  Matrix stiffness(double, const Vector& q, const Vector&, TangentKind kind) const override {
    const double z = height(q), L = std::hypot(1, z), along = 2 * z * z / (L * L * L);
    return scalar(kind == TangentKind::gauss_newton ? along : along - 2 * (1 / L - 1 / rest_length()));
  }
  double load_;
};

struct Analysis {
  Analysis(const Model& model, const LoadStepping& stepping, const std::string& solver = "{type: kinsol}",
           const PathTimes& t = 0)
      : path(model, t, Vector::Zero(model.num_dofs())),
        solver_(Registry<EquilibriumChoice>::read(Config::from_text(solver))
                    ->make(path, {std::max(path.largest_load(), 1e-300), 0.1})),
        stepper(path, *solver_, stepping, 0.1) {}

  // Steps until the full load. Returns the message of the RunError that ends the analysis early, else "".
  std::string to_the_end() {
    try {
      while (!stepper.done()) {
        stepper.step();
        states.push_back(stepper.state());
      }
      return "";
    } catch (const RunError& e) {
      return e.what();
    }
  }

  LoadPath path;
  std::unique_ptr<EquilibriumSolver> solver_;
  LoadStepper stepper;
  std::vector<State> states;
};

LinearModel pushed_chain() {
  Matrix K(3, 3);
  K << 2, -1, 0, -1, 2, -1, 0, -1, 1;
  return LinearModel(
      {.mass = Matrix::Identity(3, 3), .stiffness = K, .load = Vector::Unit(3, 2), .factor = {{0, 0}, {2, 6}}});
}

TEST(LoadStepper, OfALinearModelIsExactAtEveryLoadFactor) {
  const LinearModel chain = pushed_chain();
  Analysis analysis(chain, {.first_step = 0.125}, "{type: kinsol}", 2);
  EXPECT_EQ(analysis.to_the_end(), "");
  EXPECT_EQ(analysis.stepper.rejected(), 0);
  ASSERT_EQ(analysis.states.back().t, 1);
  // Each spring carries the whole load, 6 N at t = 2 s, so node k = 1, 2, 3 moves by 6 k at the full load.
  for (const State& s : analysis.states)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(s.q[k], 6 * s.t * (k + 1), 1e-7 * 18) << s.t;
}

TEST(LoadStepper, GrowsItsStepsWhereItIsEasyAndEndsOnTheWholeLoad) {
  const LinearModel chain = pushed_chain();
  Analysis analysis(chain, {.first_step = 0.1, .max_step = 0.4}, "{type: kinsol}", 2);
  analysis.to_the_end();
  std::vector<double> factors;
  for (const State& s : analysis.states) factors.push_back(s.t);
  ASSERT_EQ(factors.size(), 4u);
  const double expected[] = {0.1, 0.3, 0.7, 1};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(factors[k], expected[k], 1e-12);
}

TEST(LoadStepper, OfAnUnloadedModelStaysAtRest) {
  const LinearModel chain({.mass = scalar(1), .stiffness = scalar(5)});
  Analysis analysis(chain, {});
  EXPECT_EQ(analysis.to_the_end(), "");
  EXPECT_EQ(analysis.stepper.state().q[0], 0);
}

TEST(VonMisesTruss, HasTheLimitLoadOfTheClosedForm) {
  EXPECT_NEAR(Truss::limit_load(), 2.96051760e-3, 1e-11);
  EXPECT_NEAR(Truss::limit_height(), 0.11471444, 1e-8);
}

TEST(VonMisesTruss, IsFollowedBelowItsLimit) {
  const double load = 0.99 * Truss::limit_load();
  const Truss truss(load);
  Analysis analysis(truss, {});
  EXPECT_EQ(analysis.to_the_end(), "");
  const double z = Truss::height(analysis.stepper.state().q);
  EXPECT_NEAR(Truss::resistance(z), load, 1e-8 * load);
  EXPECT_GT(z, Truss::limit_height());
}

TEST(VonMisesTruss, IsFollowedUpToItsLimitAndNoFurther) {
  const Truss truss(1.5 * Truss::limit_load());
  Analysis analysis(truss, {}, "{type: kinsol, rtol: 1e-12}");
  const std::string message = analysis.to_the_end();
  const State& last = analysis.stepper.state();
  EXPECT_LE(last.t, 1 / 1.5);
  EXPECT_GE(last.t, 1 / 1.5 - 1e-6);
  EXPECT_NEAR(Truss::height(last.q), Truss::limit_height(), 1e-3 * Truss::kRise);
  EXPECT_NE(message.find("limit point at load factor 0.666667"), std::string::npos) << message;
  EXPECT_NE(message.find("snaps through"), std::string::npos) << message;
  ASSERT_EQ(analysis.stepper.critical_points().size(), 1u);
  const CriticalPoint& limit = analysis.stepper.critical_points()[0];
  EXPECT_EQ(limit.kind, CriticalPoint::Kind::limit);
  EXPECT_LE(std::abs(limit.load_factor - 1 / 1.5), limit.uncertainty);
  EXPECT_LE(limit.uncertainty, 1e-6);
}

// The path falls to the opposite limit load and rises again to the hanging truss. Each equilibrium must satisfy the
// closed form.
TEST(VonMisesTruss, IsFollowedThroughItsSnapIfAskedFor) {
  const double load = 1.5 * Truss::limit_load();
  const Truss truss(load);
  Analysis analysis(truss, {.max_step = 0.1, .at_limit = AtLimit::follow});
  EXPECT_EQ(analysis.to_the_end(), "");
  double lowest = 0;
  for (const State& s : analysis.states) {
    EXPECT_NEAR(Truss::resistance(Truss::height(s.q)), s.t * load, 1e-8 * load);
    lowest = std::min(lowest, s.t);
  }
  EXPECT_NEAR(lowest, -1 / 1.5, 1e-5);
  EXPECT_LT(Truss::height(analysis.stepper.state().q), -Truss::kRise);
  ASSERT_EQ(analysis.stepper.critical_points().size(), 2u);
  EXPECT_EQ(analysis.stepper.critical_points()[0].unstable, 1);
  EXPECT_EQ(analysis.stepper.critical_points()[1].unstable, 0);
  EXPECT_NEAR(analysis.stepper.critical_points()[1].load_factor, -1 / 1.5, 1e-6);
  EXPECT_EQ(analysis.stepper.unstable(), 0);
}

TEST(VonMisesTruss, DoesNotHopToTheOtherBranchInOneLongStep) {
  for (const double times : {1.01, 2.0, 10.0}) {
    const Truss truss(times * Truss::limit_load());
    Analysis analysis(truss, {.first_step = 1});
    EXPECT_NE(analysis.to_the_end(), "");
    for (const State& s : analysis.states) EXPECT_GT(Truss::height(s.q), Truss::limit_height() - 1e-6) << times;
  }
}

// With AtLimit::jump the stepper jumps to the branch of the hanging truss, but only if the load exceeds the limit.
TEST(VonMisesTruss, JumpsToTheOtherBranchWhenItMayAndMust) {
  for (const auto& [times, jumps] : {std::pair{0.95, 0}, {1.5, 1}}) {
    const Truss truss(times * Truss::limit_load());
    Analysis analysis(truss, {.at_limit = AtLimit::jump});
    EXPECT_EQ(analysis.to_the_end(), "") << times;
    EXPECT_EQ(analysis.stepper.jumps(), jumps);
    const double z = Truss::height(analysis.stepper.state().q);
    EXPECT_EQ(z<0, jumps> 0);
    EXPECT_NEAR(Truss::resistance(z), times * Truss::limit_load(), 1e-7 * Truss::limit_load());
  }
}

// A bar with EA = 1 from (0, 0) to (1, 0), under an axial load P at its end (x, y). A spring with the force
// k y + s y^2 + c y^3 holds the end laterally. While y = 0 the bar has the length l = 1 - P and the lateral stiffness
// k - P/l, so it buckles at P = k/(1 + k). On the buckled branch the bar's force is N = l (k + s y + c y^2), and
// P = x (k + s y + c y^2).
class Strut : public SmallModel {
 public:
  explicit Strut(double load, double skew = 0) : SmallModel(Matrix::Identity(2, 2)), load_(load), skew_(skew) {}
  static constexpr double kSpring = 0.01, kCubic = 1;
  static double critical_load() { return kSpring / (1 + kSpring); }
  double sideways(double y) const { return kSpring + skew_ * y + kCubic * y * y; }

  void force(double, const ConstVectorRef& q, const ConstVectorRef&, VectorRef f) const override {
    const double x = 1 + q[0], y = q[1], l = std::hypot(x, y);
    f[0] = -load_ - (l - 1) * x / l;
    f[1] = -(l - 1) * y / l - sideways(y) * y;
  }
  State initial() const override { return {0, Vector::Zero(2), Vector::Zero(2)}; }
  double end() const override { return 1; }

 private:
  Matrix stiffness(double, const Vector& q, const Vector&, TangentKind kind) const override {
    const Vector n = Eigen::Vector2d(1 + q[0], q[1]).normalized();
    const double l = std::hypot(1 + q[0], q[1]);
    Matrix K = n * n.transpose();
    if (kind == TangentKind::exact) K += (1 - 1 / l) * (Matrix::Identity(2, 2) - n * n.transpose());
    K(1, 1) += kSpring + 2 * skew_ * q[1] + 3 * kCubic * q[1] * q[1];
    return K;
  }
  double load_, skew_;  // P, s
};

TEST(Strut, IsFollowedUpToItsBifurcation) {
  const Strut strut(2 * Strut::critical_load());
  Analysis analysis(strut, {});
  const std::string message = analysis.to_the_end();
  EXPECT_NE(message.find("bifurcation at load factor 0.5"), std::string::npos) << message;
  ASSERT_EQ(analysis.stepper.critical_points().size(), 1u);
  const CriticalPoint& point = analysis.stepper.critical_points()[0];
  EXPECT_EQ(point.kind, CriticalPoint::Kind::bifurcation);
  EXPECT_NEAR(point.load_factor, 0.5, 1e-6);
  EXPECT_LE(analysis.stepper.state().t, 0.5);
}

TEST(Strut, StaysUprightAndUnstableIfItsPathIsFollowed) {
  const Strut strut(2 * Strut::critical_load());
  Analysis analysis(strut, {.at_limit = AtLimit::follow});
  EXPECT_EQ(analysis.to_the_end(), "");
  EXPECT_NEAR(analysis.stepper.state().q[0], -2 * Strut::critical_load(), 1e-9);
  EXPECT_NEAR(analysis.stepper.state().q[1], 0, 1e-12);
  EXPECT_EQ(analysis.stepper.unstable(), 1);
}

TEST(Strut, LeavesItsUprightPathIfItMayJump) {
  const double load = 2 * Strut::critical_load();
  const Strut strut(load);
  Analysis analysis(strut, {.at_limit = AtLimit::jump});
  EXPECT_EQ(analysis.to_the_end(), "");
  const Vector& q = analysis.stepper.state().q;
  EXPECT_GT(std::abs(q[1]), 0.05);
  EXPECT_NEAR((1 + q[0]) * strut.sideways(q[1]), load, 1e-8);
  EXPECT_EQ(analysis.stepper.jumps(), 1);
  EXPECT_EQ(analysis.stepper.unstable(), 0);
}

// Here the buckled branch reaches the full load within the first step along it.
TEST(Strut, ThatBucklesShortOfAllLoadsRestsAsideUnderThem) {
  for (const double beyond : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const double load = (1 + beyond) * Strut::critical_load();
    const Strut strut(load);
    Analysis analysis(strut, {.at_limit = AtLimit::jump});
    EXPECT_EQ(analysis.to_the_end(), "") << beyond;
    for (const State& s : analysis.states) EXPECT_LE(s.t, 1) << beyond;
    const Vector& q = analysis.stepper.state().q;
    EXPECT_GT(std::abs(q[1]), 0.5 * std::sqrt(beyond * Strut::kSpring)) << beyond;  // exact: y^2 ~ beyond k
    // The tolerance allows for the error of f[1], divided by y.
    EXPECT_NEAR((1 + q[0]) * strut.sideways(q[1]), load, 1e-8 * load / std::abs(q[1])) << beyond;
    EXPECT_EQ(analysis.stepper.unstable(), 0) << beyond;
  }
}

// On one side the load rises along the buckled branch, which is stable there. On the other side it falls.
TEST(Strut, OfUnequalSidesLeavesToTheOneOnWhichItIsStable) {
  for (const double skew : {0.05, -0.05}) {
    const double load = 2 * Strut::critical_load();
    const Strut strut(load, skew);
    Analysis analysis(strut, {.at_limit = AtLimit::jump});
    EXPECT_EQ(analysis.to_the_end(), "") << skew;
    const Vector& q = analysis.stepper.state().q;
    EXPECT_GT(q[1] * skew, 0) << skew;
    EXPECT_NEAR((1 + q[0]) * strut.sideways(q[1]), load, 1e-8) << skew;
  }
}

// A bar, q + 10 q^3 = load, that cannot be evaluated for q > 1. Early Newton iterates would exceed this.
class Fragile : public SmallModel {
 public:
  Fragile() : SmallModel(scalar(1)) {}
  void force(double, const ConstVectorRef& q, const ConstVectorRef&, VectorRef f) const override {
    if (q[0] > 1) throw RecoverableError("torn");
    f[0] = load - (q[0] + 10 * q[0] * q[0] * q[0]);
  }
  State initial() const override { return {0, Vector::Zero(1), Vector::Zero(1)}; }
  double end() const override { return 1; }
  double load = 10;

 private:
  Matrix stiffness(double, const Vector& q, const Vector&, TangentKind) const override {
    return scalar(1 + 30 * q[0] * q[0]);
  }
};

TEST(LoadStepper, CutsBackWhereTheModelCannotBeEvaluated) {
  Fragile bar;
  Analysis analysis(bar, {.first_step = 1});
  EXPECT_EQ(analysis.to_the_end(), "");
  const double q = analysis.stepper.state().q[0];
  EXPECT_NEAR(q + 10 * q * q * q, 10, 1e-6);
}

TEST(LoadStepper, SaysHowFarItCameAndWhyNotFurther) {
  Fragile bar;
  bar.load = 20;  // more than 11, the force at q = 1
  Analysis analysis(bar, {.min_step = 1e-3});
  const std::string message = analysis.to_the_end();
  EXPECT_NE(message.find("no equilibrium was found beyond load factor 0.5"), std::string::npos) << message;
  EXPECT_NE(message.find("torn"), std::string::npos) << message;
  EXPECT_GT(analysis.stepper.state().t, 0.54);
  EXPECT_LE(analysis.stepper.state().t, 0.55);
}

// One end of a spring is moved by t. The model cannot be evaluated for t > 0.5.
class Drawn : public SmallModel {
 public:
  Drawn() : SmallModel(scalar(1)) {}
  void force(double t, const ConstVectorRef& q, const ConstVectorRef&, VectorRef f) const override {
    if (t > 0.5) throw RecoverableError("torn");
    f[0] = t - q[0];
  }
  State initial() const override { return {0, Vector::Zero(1), Vector::Zero(1)}; }
  double end() const override { return 1; }

 private:
  Matrix stiffness(double, const Vector&, const Vector&, TangentKind) const override { return scalar(1); }
};

TEST(LoadStepper, EndsWhereItsTangentCannotBeEvaluated) {
  const Drawn spring;
  Analysis analysis(spring, {.min_step = 1e-3}, "{type: kinsol}", {0, 1});
  const std::string message = analysis.to_the_end();
  EXPECT_NE(message.find("no equilibrium was found beyond load factor 0.49"), std::string::npos) << message;
  EXPECT_GE(analysis.stepper.state().t, 0.5 - 2e-3);
}

// An equilibrium counts as far away if lambda changes by more than the scaled displacement does. This is so for the
// stiffening bar q + 10 q^3 = lambda, but not for the softening truss.
TEST(PathTracer, FindsAnEquilibriumAsideUnlessItIsFarAway) {
  const Vector shift = Vector::Constant(1, 0.1 * Truss::kRise);
  const Truss truss(Truss::limit_load());
  Analysis soft(truss, {});
  const auto found = PathTracer(soft.path, *soft.solver_).branch_at(shift);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->point.q[0], shift[0], 1e-15);
  EXPECT_NEAR(found->point.lambda, Truss::resistance(0.9 * Truss::kRise) / Truss::limit_load(), 1e-7);
  Fragile bar;
  bar.load = 1;
  Analysis stiff(bar, {});
  PathTracer tracer(stiff.path, *stiff.solver_);
  EXPECT_FALSE(tracer.branch_at(shift));
  EXPECT_EQ(tracer.last_attempt().failure_reason, "Newton's method converged to a distant equilibrium");
}

TEST(LoadStepper, GivesUpAfterTheStepsAllowed) {
  const LinearModel chain = pushed_chain();
  Analysis analysis(chain, {.first_step = 0.1, .max_step = 0.1, .max_steps = 3}, "{type: kinsol}", 2);
  const std::string message = analysis.to_the_end();
  EXPECT_NE(message.find("gave up at load factor 0.3 after 3 steps"), std::string::npos) << message;
}

TEST(Kinsol, ConvergesQuadratically) {
  Fragile bar;
  bar.load = 1;
  for (const auto& [rtol, most] : {std::pair{"1e-4", 6l}, {"1e-12", 8l}}) {
    Analysis analysis(bar, {.first_step = 1}, std::string("{type: kinsol, rtol: ") + rtol + "}");
    EXPECT_EQ(analysis.to_the_end(), "");
    EXPECT_LE(analysis.stepper.attempt().iterations, most) << rtol;
  }
}

TEST(Kinsol, NamesTheSolversThatItTakes) {
  try {
    Registry<EquilibriumChoice>::read(Config::from_text("{type: kinsol, linear_solver: klu_full}"));
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("cholesky"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace orthodyn::load_stepper_test
