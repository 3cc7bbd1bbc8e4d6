// Properties of the leapfrog scheme: critical step, invariants, refusals.
#include <numbers>

#include "integrators/critical_step.h"
#include "tests/contract/integrators.h"

namespace orthodyn::central_differences_test {
namespace {

std::unique_ptr<Integrator> leapfrog(const SmallModel& model, const std::string& keys = "") {
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{type: central_differences" + keys + "}"));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
}

double critical_step(const SmallModel& model) {
  Statistics statistics;
  return CriticalStep(model, statistics).at(model.initial());
}

LinearModel oscillator(double omega, double beta, double end) {
  return LinearModel({.mass = scalar(2),
                      .stiffness = scalar(2 * omega * omega),
                      .beta = beta,
                      .start = Vector::Ones(1),
                      .end = end,
                      .velocity_scale = omega});
}

// Masses 1 and springs 1 between walls: omega_k = 2 sin(k pi / (2 (n + 1))).
LinearModel undamped_chain(int n, double beta = 0) {
  Matrix K = 2 * Matrix::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i) K(i, i + 1) = K(i + 1, i) = -1;
  return LinearModel(
      {.mass = Matrix::Identity(n, n), .stiffness = K, .beta = beta, .start = Vector::Unit(n, 0), .end = 8});
}

double highest_frequency(int n) { return 2 * std::sin(n * std::numbers::pi / (2 * (n + 1))); }

TEST(CriticalStep, OfAChainIsTwoOverItsHighestFrequency) {
  for (const int n : {1, 2, 8, 20}) {
    const double exact = 2 / highest_frequency(n);
    EXPECT_NEAR(critical_step(undamped_chain(n)), exact, 1e-12 * exact) << n;
  }
}

// The bound adds the residual to the Ritz value: the step is never above the critical one, and hardly below.
TEST(CriticalStep, OfALongChainIsJustBelowTwoOverItsHighestFrequency) {
  const double exact = 2 / highest_frequency(400), found = critical_step(undamped_chain(400));
  EXPECT_LE(found, exact * (1 + 1e-12));
  EXPECT_GE(found, 0.985 * exact);
}

TEST(CriticalStep, WithStiffnessDampingFollowsFromTheHighestFrequency) {
  const double omega = highest_frequency(8), xi = 0.1 * omega / 2;
  const double exact = 2 / omega * (std::sqrt(1 + 4 * xi * xi) - 2 * xi);
  EXPECT_NEAR(critical_step(undamped_chain(8, 0.1)), exact, 1e-12);
}

// Growth of the largest component in a thousand steps of the scheme's formulas, on q'' = -omega^2 q - 2 xi omega q'
// with omega = 1.
double growth(double h, double xi) {
  double q = 1, v = 0, a = -1;
  for (int k = 0; k < 1000; ++k) {
    q += h * v + 0.5 * h * h * a;
    const double next = -q - 2 * xi * (v + h * a);
    v += 0.5 * h * (a + next);
    a = next;
  }
  return std::max({std::abs(q), std::abs(v), std::abs(a)});
}

TEST(CriticalStep, DividesDecayFromGrowth) {
  for (const double xi : {0.01, 0.1, 0.5, 1.0, 3.0}) {
    const double limit = critical_step(oscillator(1, 2 * xi, 1));
    EXPECT_LT(growth(0.99 * limit, xi), 1) << xi;
    EXPECT_GT(growth(1.01 * limit, xi), 10) << xi;
  }
}

// The leapfrog conserves v^2 + omega^2 (1 - (h omega)^2 / 4) q^2 to round-off.
TEST(CentralDifferences, KeepTheirOwnEnergyOverAHundredThousandSteps) {
  const double omega = 3, h = 0.95 * 2 / omega;
  const auto model = oscillator(omega, 0, 1e5 * h);
  const auto kept = [&](const State& s) {
    return s.v[0] * s.v[0] + omega * omega * (1 - h * h * omega * omega / 4) * s.q[0] * s.q[0];
  };
  double most = 0;
  const auto integrator = leapfrog(model, fmt::format(", step: {}", h));
  integrate(model, *integrator, [&](const StepInfo& info, const Integrator& i) {
    if (info.t == model.end()) return;  // the last step may be shorter
    State state;
    i.interpolate(info.t, state);
    most = std::max(most, std::abs(kept(state) / kept(model.initial()) - 1));
  });
  EXPECT_LE(most, 1e-9);
  EXPECT_GE(integrator->statistics().steps, 99'999);
}

TEST(CentralDifferences, AreOfSecondOrderWithAForceThatDependsOnVelocity) {
  std::vector<double> errors;
  const std::vector<double> steps = {0.1, 0.05, 0.025, 0.0125};
  for (const double h : steps) {
    const auto model = damped_oscillator();
    double error = 0;
    integrate(model, *leapfrog(model, fmt::format(", step: {}", h)), [&](const StepInfo& info, const Integrator& i) {
      State state;
      i.interpolate(info.t, state);
      error = std::max(error, distance(state, model.exact(info.t), model.scales()));
    });
    errors.push_back(error);
  }
  EXPECT_NEAR(slope(steps, errors), 2, 0.15);
}

std::string reading_refusal(const SmallModel& model, const std::string& keys) {
  try {
    leapfrog(model, keys);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(CentralDifferences, RefuseAStepAboveTheCriticalOneAndNameIt) {
  const auto model = oscillator(4, 0, 1);
  EXPECT_EQ(reading_refusal(model, ", step: 0.4999"), "");
  const auto message = reading_refusal(model, ", step: 0.5001");
  EXPECT_NE(message.find("critical step, 0.5 s"), std::string::npos) << message;
  EXPECT_NE(message.find("step: auto"), std::string::npos) << message;
}

TEST(CentralDifferences, RefuseARunOfMoreStepsThanAllowedAndNameTheirNumber) {
  const auto message = reading_refusal(oscillator(1e6, 0, 1), ", max_steps: 1000");
  EXPECT_NE(message.find("5.6e+05 steps"), std::string::npos) << message;
  EXPECT_NE(message.find("implicit"), std::string::npos) << message;
}

TEST(CentralDifferences, SayWhichStepTheyChose) {
  const auto decisions = leapfrog(oscillator(4, 0, 10))->decisions();
  ASSERT_EQ(decisions.size(), 1u);
  EXPECT_EQ(decisions[0].first, "step");
  EXPECT_EQ(decisions[0].second, "auto, at first 0.45 s (critical 0.5 s by Lanczos)");
}

TEST(CentralDifferences, TakeEvenStepsOfTheirOwnChoiceUpToAStop) {
  const auto model = oscillator(4, 0, 1);
  const auto integrator = leapfrog(model);
  integrate(model, *integrator, [](const StepInfo& info, const Integrator&) { EXPECT_NEAR(info.h, 1.0 / 3, 1e-12); });
  EXPECT_EQ(integrator->statistics().steps, 3);
}

// A slow motion x that stiffens a fast one y: U = (w^2 x^2 + (1 + 3 x^2) y^2) / 2. The fast frequency doubles from x =
// 0 to 1.
class StiffeningPair : public SmallModel {
 public:
  static constexpr double kSlow = 2e-4;
  explicit StiffeningPair(double told = 1) : SmallModel(Matrix::Identity(2, 2)), told_(told) {}
  void force(double, const ConstVectorRef& q, const ConstVectorRef&, VectorRef f) const override {
    f[0] = -kSlow * kSlow * q[0] - 3 * q[0] * q[1] * q[1];
    f[1] = -(1 + 3 * q[0] * q[0]) * q[1];
  }
  double energy(const State& s) const {
    const double x = s.q[0], y = s.q[1];
    return 0.5 * s.v.squaredNorm() + 0.5 * kSlow * kSlow * x * x + 0.5 * (1 + 3 * x * x) * y * y;
  }
  State initial() const override { return {0, Vector::Unit(2, 1) * 1e-5, Vector::Unit(2, 0) * kSlow}; }
  double end() const override { return 4 / kSlow; }

 private:
  Matrix stiffness(double, const Vector& q, const Vector&, TangentKind) const override {
    const double x = q[0], y = q[1];
    Matrix K(2, 2);
    K << kSlow * kSlow + 3 * y * y, 6 * x * y, 6 * x * y, 1 + 3 * x * x;
    return told_ * K;
  }
  double told_;  // fraction of the stiffness in the tangent
};

TEST(CentralDifferences, RenewTheirStepAsTheStiffnessGrows) {
  const StiffeningPair model;
  const auto integrator = leapfrog(model);
  double longest = 0, shortest = 1e300;
  const State last = integrate(model, *integrator, [&](const StepInfo& info, const Integrator&) {
    if (info.t == model.end()) return;
    longest = std::max(longest, info.h);
    shortest = std::min(shortest, info.h);
  });
  EXPECT_NEAR(longest, 0.9 * 2, 0.05);
  EXPECT_NEAR(shortest, 0.9 * 1, 0.05);
  EXPECT_NEAR(model.energy(last), model.energy(model.initial()), 0.1 * model.energy(model.initial()));
  EXPECT_LE(std::abs(last.q[1]), 1e-4);
  EXPECT_LT(integrator->statistics().tangent.count, integrator->statistics().steps / 20);
}

RunError failure(const SmallModel& model, const std::string& keys) {
  const auto integrator = leapfrog(model, keys);
  try {
    integrate(model, *integrator);
  } catch (const RunError& e) {
    return e;
  }
  return RunError("");
}

TEST(CentralDifferences, EndWhereTheCriticalStepFallsBelowAFixedOne) {
  const RunError error = failure(StiffeningPair(), ", step: 1.9");
  const std::string message = error.what();
  EXPECT_EQ(error.reason(), Reason::diverged);
  EXPECT_NE(message.find("the critical step has fallen to"), std::string::npos) << message;
  EXPECT_NE(message.find("below integrator.step, 1.9 s"), std::string::npos) << message;
}

// The tangent has a hundredth of the stiffness: the step is far too long without being detected in advance.
TEST(CentralDifferences, EndWithARemedyWhereTheMotionGrowsWithoutBound) {
  const RunError error = failure(StiffeningPair(0.01), "");
  const std::string message = error.what();
  EXPECT_NE(message.find("central_differences stopped at t = "), std::string::npos) << message;
  EXPECT_NE(message.find("lower integrator.safety"), std::string::npos) << message;
}

class PairOfOneMetre : public StiffeningPair {
 public:
  PairOfOneMetre() : StiffeningPair(0.01) {}
  Geometry geometry() const override { return {{Vec3::Zero(), Vec3::UnitX()}, {}}; }
};

// Detected long before overflow.
TEST(CentralDifferences, EndWhereAForceWouldMoveANodeByTheWholeBodyInAStep) {
  const PairOfOneMetre model;
  const auto integrator = leapfrog(model);
  double farthest = 0;
  try {
    integrate(model, *integrator, [&](const StepInfo& info, const Integrator& i) {
      State state;
      i.interpolate(info.t, state);
      farthest = std::max(farthest, state.q.lpNorm<Eigen::Infinity>());
    });
    FAIL() << "nothing was thrown";
  } catch (const RunError& e) {
    const std::string message = e.what();
    EXPECT_EQ(e.reason(), Reason::diverged);
    EXPECT_NE(message.find("the motion has grown without bound"), std::string::npos) << message;
  }
  EXPECT_LE(farthest, 1);
}

TEST(CentralDifferences, RefuseASafetyBesideAFixedStep) {
  try {
    Registry<IntegratorChoice>::read(Config::from_text("{type: central_differences, step: 0.1, safety: 0.5}"));
    FAIL() << "nothing was thrown";
  } catch (const ConfigError& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find("safety: is not used with a fixed step"), std::string::npos) << message;
  }
}

// A unit mass on a spring of 1 N/m that hits a wall at x = -1/2, a hundred times stiffer.
class Wall : public SmallModel {
 public:
  static constexpr double kWall = 100;
  explicit Wall(bool told) : SmallModel(Matrix::Identity(1, 1)), told_(told) {}
  void force(double, const ConstVectorRef& q, const ConstVectorRef&, VectorRef f) const override {
    f[0] = -q[0] + kWall * depth(q);
  }
  double energy(const State& s) const {
    return 0.5 * (s.v.squaredNorm() + s.q.squaredNorm() + kWall * depth(s.q) * depth(s.q));
  }
  std::vector<std::string> force_parts() const override { return {"spring", "wall"}; }
  std::unique_ptr<Model> only(const std::vector<std::string>& parts) const override {
    return std::make_unique<Bounded>(told_ && parts[0] == "wall" ? std::sqrt(kWall) : 0);
  }
  State initial() const override { return {0, Vector::Ones(1), Vector::Zero(1)}; }
  double end() const override { return 30; }

 private:
  static double depth(const ConstVectorRef& q) { return std::max(-0.5 - q[0], 0.0); }
  struct Bounded : LinearModel {
    explicit Bounded(double bound) : LinearModel({.mass = scalar(1), .stiffness = scalar(0)}), bound_(bound) {}
    double frequency_bound() const override { return bound_; }
    double bound_;
  };
  Matrix stiffness(double, const Vector& q, const Vector&, TangentKind) const override {
    return scalar(depth(q) > 0 ? 1 + kWall : 1);
  }
  bool told_;
};

TEST(CentralDifferences, KeepAStepThatIsStableWhenContactSetsIn) {
  const Wall model(true);
  const double safe = 2 / std::sqrt(1 + Wall::kWall);
  EXPECT_NEAR(critical_step(model), safe, 1e-9);
  const auto integrator = leapfrog(model, ", safety: 0.5");
  integrate(model, *integrator, [&](const StepInfo& info, const Integrator& i) {
    State state;
    i.interpolate(info.t, state);
    EXPECT_LE(info.h, 0.5 * safe * (1 + 1e-9));
    EXPECT_LE(model.energy(state), 4 * model.energy(model.initial()));
  });
  EXPECT_NE(reading_refusal(model, ", step: 0.3").find("above the critical step, 0.199"), std::string::npos);
}

// The step of the free flight, ten times too long for the wall.
TEST(CriticalStep, IsThatOfTheStateWhereNoPartTellsABound) { EXPECT_NEAR(critical_step(Wall(false)), 2, 1e-9); }

TEST(CentralDifferences, ServeAConsistentMass) {
  const auto model = chain(true);
  const auto integrator = leapfrog(model, ", safety: 0.02");
  const State last = integrate(model, *integrator);
  EXPECT_LE(distance(last, model.exact(last.t), model.scales()), 1e-3);
}

}  // namespace
}  // namespace orthodyn::central_differences_test
