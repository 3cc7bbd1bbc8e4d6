// Modal integration: the oscillator in closed form, time-dependent loads, and refusals.
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "integrators/native/chebyshev_interpolation.h"
#include "integrators/native/oscillator.h"
#include "tests/contract/integrators.h"

namespace orthodyn::modal_test {
namespace {

std::unique_ptr<Integrator> modal(const SmallModel& model, const std::string& keys) {
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{type: modal" + keys + "}"));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
}

struct Damping {
  double d, lambda;
};

// Overdamped, underdamped, critical and nearly critical, undamped, without stiffness, without both.
const std::vector<Damping> kOscillators = {
    {0, 1}, {0.1, 1},  {2, 1},   {2 * (1 + 1e-9), 1}, {2 * (1 - 1e-9), 1}, {2.2, 1}, {5, 1}, {50, 1}, {1e4, 1}, {1, 0},
    {0, 0}, {1, 1e-6}, {1e-8, 1}};

// State after a step h from the matrix exponential of the system in r, h r' and the scaled derivatives of the load.
Oscillation by_matrix_exponential(const Damping& o, Oscillation start, const Vector& c, double h) {
  const Eigen::Index m = c.size();
  Matrix A = Matrix::Zero(2 + m, 2 + m);
  A(0, 1) = 1;
  A(1, 0) = -o.lambda * h * h;
  A(1, 1) = -o.d * h;
  A(1, 2) = h * h;
  Vector y(2 + m);
  y[0] = start.r, y[1] = h * start.rate, y[2] = c[0];
  double factorial = 1;
  for (Eigen::Index k = 1; k < m; ++k) {
    A(1 + k, 2 + k) = 1;
    y[2 + k] = c[k] * (factorial *= static_cast<double>(k));
  }
  const Vector end = A.exp() * y;
  return {end[0], end[1] / h};
}

TEST(Oscillator, AgreesWithTheMatrixExponential) {
  const Vector c{{0.3, -1, 2, 0.5, -0.7, 1}};
  for (const Damping& o : kOscillators)
    for (const double h : {1e-3, 0.1, 1.0, 3.0, 5.0, 12.0}) {
      if (o.d * h > 40) continue;  // not usable for a stiff oscillator
      const Oscillation got = oscillate(o.d, o.lambda, {1, -0.5}, c, h, h);
      const Oscillation expected = by_matrix_exponential(o, {1, -0.5}, c, h);
      EXPECT_NEAR(got.r, expected.r, 2e-12 * (1 + h * h)) << o.d << " " << o.lambda << " " << h;
      EXPECT_NEAR(got.rate, expected.rate, 2e-12 * (1 + h)) << o.d << " " << o.lambda << " " << h;
    }
}

// Two half steps equal one step for any step size: the formulas for small and large arguments agree.
TEST(Oscillator, TakesTwoHalfStepsAsOne) {
  const Vector c{{0.3, -1}};
  for (const Damping& o : kOscillators)
    for (double h = 1e-9; h < 1e7; h *= 3.7) {
      const Oscillation whole = oscillate(o.d, o.lambda, {1, -0.5}, c, h, h);
      const Oscillation half = oscillate(o.d, o.lambda, {1, -0.5}, c, h, h / 2);
      const Oscillation halves = oscillate(o.d, o.lambda, half, Vector{{0.3 - 0.5, -0.5}}, h / 2, h / 2);
      const double phase = std::sqrt(o.lambda) * h;                            // known to eps of it
      const double unbound = o.lambda > 0 ? 1 / o.lambda : h / (o.d + 1 / h);  // of the response to the load
      const double size = 2 + std::min(unbound, h * h);
      const double speed = 2 + std::min({std::sqrt(o.lambda) * size, h, size / h + 1});
      EXPECT_NEAR(halves.r, whole.r, 1e-14 * (10 + phase) * size) << o.d << " " << o.lambda << " " << h;
      EXPECT_NEAR(halves.rate, whole.rate, 1e-14 * (10 + phase) * speed) << o.d << " " << o.lambda << " " << h;
    }
}

TEST(Oscillator, HasTheKnownFormulas) {
  const Vector none = Vector::Zero(1), one = Vector::Ones(1);
  for (const double t : {1e-8, 1e-3, 0.3, 2.0, 30.0}) {
    EXPECT_NEAR(oscillate(0, 9, {1, 2}, none, t, t).r, std::cos(3 * t) + 2.0 / 3 * std::sin(3 * t), 1e-14 * (3 + t));
    EXPECT_NEAR(oscillate(6, 9, {1, 2}, none, t, t).r, (1 + 5 * t) * std::exp(-3 * t), 1e-14);
    EXPECT_NEAR(oscillate(10, 9, {1, -1}, none, t, t).r, std::exp(-t), 1e-14);
    EXPECT_NEAR(oscillate(0, 0, {0, 0}, one, t, t).r, t * t / 2, 1e-15 * t * t);
    EXPECT_NEAR(oscillate(2, 0, {0, 0}, one, t, t).r, (t + std::expm1(-2 * t) / 2) / 2, 1e-15 * t + 1e-13 * t * t);
    EXPECT_NEAR(oscillate(0, 4, {0, 0}, one, t, t).r, std::pow(std::sin(t), 2) / 2, 1e-14 * t * t + 1e-17);
  }
  // Stiff and strongly damped: static under its load after any but a tiny time.
  EXPECT_NEAR(oscillate(1e8, 1e10, {1, 0}, Vector::Constant(1, 1e10), 1, 1).r, 1, 1e-14);
}

TEST(LoadPolynomial, IsExactForDegreeFive) {
  const Vector c{{1, -2, 3, 0.5, -4, 2}};
  Matrix values(1, kLoadTerms);
  for (Eigen::Index j = 0; j < kLoadTerms; ++j)
    values.col(j) = polynomial_value(c.transpose(), chebyshev_points()[static_cast<std::size_t>(j)]);
  EXPECT_LE((polynomial_coefficients(values) - c.transpose()).norm(), 1e-11);
  EXPECT_NEAR(polynomial_slope(c.transpose(), 0.5)[0], -2 + 3 + 0.375 - 2 + 0.625, 1e-14);
  EXPECT_NEAR(polynomial_curvature(c.transpose(), 0.5)[0], 6 + 1.5 - 12 + 5, 1e-14);
}

// M = 1, K = 9, under sin(W t).
Disturbed<LinearModel> shaken(double W, double end) {
  const LinearModel still({.mass = scalar(1), .stiffness = scalar(9), .load = Vector::Zero(1), .end = end});
  return {still, [W](long, double t, VectorRef f) { f[0] += std::sin(W * t); }};
}

TEST(Modal, FollowsASineOffAndAtResonance) {
  for (const double W : {0.7, 3.0, 20.0})
    for (const double rtol : {1e-4, 1e-8}) {
      const auto model = shaken(W, 30);
      const auto integrator = modal(model, fmt::format(", modes: 1, rtol: {}", rtol));
      double largest = 0;
      integrate(model, *integrator, [&](const StepInfo& info, const Integrator& i) {
        for (const double share : {0.4, 0.0}) {
          State s;
          i.interpolate(info.t - share * info.h, s);
          const double t = s.t;
          const double exact = W == 3 ? (std::sin(3 * t) / 3 - t * std::cos(3 * t)) / 6
                                      : (std::sin(W * t) - W / 3 * std::sin(3 * t)) / (9 - W * W);
          largest = std::max(largest, std::abs(s.q[0] - exact));
        }
      });
      EXPECT_LE(largest, 10 * rtol) << W;
      EXPECT_GT(integrator->statistics().steps, 10);
    }
}

TEST(Modal, TakesOneStepUnderALoadThatIsConstant) {
  const auto model = bathes_two_masses();
  const auto integrator = modal(model, ", modes: 2, h_max: 100");
  const State last = integrate(model, *integrator);
  EXPECT_LE(distance(last, model.exact(last.t), model.scales()), 1e-12);
  EXPECT_LE(integrator->statistics().steps, 51);  // the model declares a time-dependent load: one sample per output
  const auto swinging = harmonic_oscillator();
  const auto free = modal(swinging, ", modes: 1");
  EXPECT_LE(distance(integrate(swinging, *free), swinging.exact(swinging.end()), swinging.scales()), 1e-12);
  EXPECT_EQ(free->statistics().steps, 1);
}

// A jump belongs to the step that begins at it, whichever value the load has at that time.
TEST(Modal, KnowsNothingOfALoadBeyondTheStop) {
  const LinearModel still({.mass = scalar(1), .stiffness = scalar(9), .load = Vector::Zero(1), .end = 2});
  for (const bool late : {false, true}) {
    const Disturbed<LinearModel> model(still, [late](long, double t, VectorRef f) {
      if (t < 1 || (late && t == 1)) f[0] += 9;
    });
    const auto integrator = modal(model, ", modes: 1");
    State state = model.initial();
    for (const double stop : {1.0, 2.0}) {
      integrator->start(state);
      while (integrator->step(stop).t < stop) {
      }
      integrator->interpolate(stop, state);
    }
    EXPECT_NEAR(state.q[0], std::cos(3.0) - std::cos(6.0), 1e-12);
  }
}

std::string refusal(const SmallModel& model, const std::string& keys) {
  try {
    modal(model, keys);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Modal, WantsToKnowWhichModesToKeep) {
  EXPECT_TRUE(contains(refusal(chain(false), ""), "`modes`") && contains(refusal(chain(false), ""), "`below`"));
  EXPECT_TRUE(contains(refusal(chain(false), ", modes: 3, below: 1 Hz"), "remove one of the two"));
}

TEST(Modal, RefusesModelsThatAreNotLinear) {
  EXPECT_TRUE(contains(refusal(pendulum(), ", modes: 2"), "kinematics: linear"));
}

TEST(Modal, KeepsTheModesBelowAFrequency) {
  const LinearModel slow(
      {.mass = Matrix::Identity(3, 3), .stiffness = Vector{{1, 4, 9}}.asDiagonal(), .start = Vector::Unit(3, 0)});
  const auto kept = [&](const std::string& keys) {
    for (const auto& [key, value] : modal(slow, keys)->decisions())
      if (key == "kept") return value;
    return std::string();
  };
  EXPECT_TRUE(kept(", below: 0.4 Hz").starts_with("2 modes up to 0.31831 Hz")) << kept(", below: 0.4 Hz");
  EXPECT_TRUE(contains(kept(", below: 1 kHz"), "3 modes up to 0.477465 Hz, all modes of the model"))
      << kept(", below: 1 kHz");
  EXPECT_TRUE(contains(kept(", modes: 50"), "all modes of the model"));
  EXPECT_TRUE(contains(refusal(slow, ", below: 0.1 Hz"), "the first is at 0.159155 Hz; raise `below`"));
}

TEST(Modal, RefusesAStartThatItsModesDoNotHold) {
  const std::string message = refusal(chain(false), ", modes: 2");
  EXPECT_TRUE(contains(message, "(`modes`, `below`)")) << message;
  EXPECT_EQ(refusal(chain(false), ", modes: 8"), "");
}

TEST(Modal, RefusesToLeaveRigidMotionsOut) {
  const Matrix K{{1, -1, 0}, {-1, 1, 0}, {0, 0, 0}};
  const LinearModel free({.mass = Matrix::Identity(3, 3), .stiffness = K, .start = Vector::Ones(3)});
  EXPECT_TRUE(contains(refusal(free, ", modes: 1"), "motions without stiffness")) << refusal(free, ", modes: 1");
  EXPECT_EQ(refusal(free, ", modes: 2"), "");
}

// Two masses joined by a spring, the first on a dashpot.
class OnADashpot : public LinearModel {
 public:
  OnADashpot() : LinearModel({.mass = Matrix::Identity(2, 2), .stiffness = Matrix{{2, -1}, {-1, 2}}}) {
    traits_.damping_matrix = true;
  }

 private:
  Matrix damping(const Vector&) const override { return Vector{{0.3, 0}}.asDiagonal(); }
};

TEST(Modal, RefusesDampingThatCouplesTheModes) {
  const std::string message = refusal(OnADashpot(), ", modes: 2");
  EXPECT_TRUE(contains(message, "alpha M + beta K")) << message;
  EXPECT_TRUE(contains(message, "the same stiffness damping")) << message;
}

TEST(Modal, TheSameRunTwiceIsTheSameToTheLastBit) {
  const auto model = chain(true);
  const State a = integrate(model, *modal(model, ", modes: 8")), b = integrate(model, *modal(model, ", modes: 8"));
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.v, b.v);
}

}  // namespace
}  // namespace orthodyn::modal_test
