// Explicit Runge-Kutta methods on the imaginary axis and the options of their tables; iterations of Adams methods.
#include "tests/contract/integrators.h"

namespace orthodyn::explicit_runge_kutta_test {
namespace {

std::unique_ptr<Integrator> make(const SmallModel& model, const std::string& yaml) {
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text(yaml));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
}

// The amplitude after two hundred steps of h omega.
double amplitude(const std::string& table, double h_omega) {
  const double omega = 3, h = h_omega / omega;
  const LinearModel model({.mass = scalar(2),
                           .stiffness = scalar(2 * omega * omega),
                           .start = Vector::Ones(1),
                           .end = 200 * h,
                           .velocity_scale = omega});
  const auto yaml = fmt::format("{{type: arkode_erk, table: {}, step: {:.17g}}}", table, h);
  const State last = integrate(model, *make(model, yaml));
  return std::hypot(last.q[0], last.v[0] / omega);
}

// R(z) is the Taylor polynomial. On the imaginary axis, degree 4 is stable up to 2 sqrt 2, degree 3 up to sqrt 3,
// degree 2 nowhere (Hairer & Wanner 1996, IV.2).
TEST(ArkodeErk, IsStableOnTheImaginaryAxisUpToItsPolynomialsLimit) {
  EXPECT_LT(amplitude("ZONNEVELD_5_3_4", 0.99 * 2 * std::sqrt(2)), 1);
  EXPECT_GT(amplitude("ZONNEVELD_5_3_4", 1.01 * 2 * std::sqrt(2)), 10);
  EXPECT_LT(amplitude("KNOTH_WOLKE_3_3", 0.99 * std::sqrt(3)), 1);
  EXPECT_GT(amplitude("KNOTH_WOLKE_3_3", 1.01 * std::sqrt(3)), 2);
  EXPECT_GT(amplitude("HEUN_EULER_2_1_2", 0.3), 1.1);
}

TEST(ArkodeErk, EndsWhereTheMotionGrowsWithoutBoundWithTheRemedy) {
  const LinearModel model({.mass = scalar(2), .stiffness = scalar(18), .start = Vector::Ones(1), .end = 1e4});
  try {
    integrate(model, *make(model, "{type: arkode_erk, step: 2}"));
    FAIL() << "nothing was thrown";
  } catch (const RunError& e) {
    const std::string message = e.what();
    EXPECT_EQ(e.reason(), Reason::diverged) << message;
    EXPECT_NE(message.find("lower integrator.step"), std::string::npos) << message;
  }
}

TEST(ArkodeErk, EvaluatesNoForceTwiceAtTheEndOfAStep) {
  const auto model = harmonic_oscillator();
  for (const auto& [table, stages] : std::vector<std::pair<std::string, int>>{
           {"BOGACKI_SHAMPINE_4_2_3", 3}, {"DORMAND_PRINCE_7_4_5", 6}, {"CASH_KARP_6_4_5", 6}}) {
    const auto integrator = make(model, fmt::format("{{type: arkode_erk, table: {}, step: 0.01}}", table));
    integrate(model, *integrator);
    EXPECT_LE(integrator->statistics().force.count, stages * integrator->statistics().steps + 3) << table;
  }
}

TEST(ArkodeErk, RefusesToControlTheErrorByATableWithoutAnEstimate) {
  const auto message = reading_refusal("{type: arkode_erk, table: KNOTH_WOLKE_3_3}");
  EXPECT_NE(message.find("no error estimate; give integrator.step"), std::string::npos) << message;
  EXPECT_EQ(reading_refusal("{type: arkode_erk, table: KNOTH_WOLKE_3_3, step: 0.1}"), "");
}

// omega = 1e6 over 10 s: 4 critical steps of 2/omega are 8e-6 s, so 1.25e6 steps; a Krylov space of 40 reaches 4e-5 s.
TEST(ExplicitMethods, RefuseARunOfMoreStepsThanAllowedAndNameTheirNumber) {
  const LinearModel model({.mass = scalar(1), .stiffness = scalar(1e12), .start = Vector::Ones(1), .end = 10});
  for (const auto& [keys, steps] : std::vector<std::pair<std::string, std::string>>{
           {"type: arkode_erk", "1.2e+06 steps"},
           {"type: exponential_rosenbrock, max_steps: 10000", "2.5e+05 steps"}}) {
    try {
      make(model, "{" + keys + "}");
      FAIL() << keys;
    } catch (const ConfigError& e) {
      const std::string message = e.what();
      EXPECT_NE(message.find(steps), std::string::npos) << message;
      EXPECT_NE(message.find("use an implicit integrator, or raise max_steps"), std::string::npos) << message;
    }
  }
  EXPECT_NO_THROW(make(model, "{type: arkode_erk, max_steps: 2000000}"));
  EXPECT_NO_THROW(make(model, "{type: exponential_rosenbrock, max_steps: 300000}"));
}

TEST(CvodeAdams, BothIterationsAgreeAtATightTolerance) {
  const auto model = damped_oscillator();
  const State newton = integrate(model, *make(model, "{type: cvode_adams, rtol: 1e-9, nonlinear: newton}"));
  for (const std::string more : {"", ", anderson: 2"}) {
    const auto integrator = make(model, "{type: cvode_adams, rtol: 1e-9, nonlinear: fixed_point" + more + "}");
    const State last = integrate(model, *integrator);
    EXPECT_LE(distance(last, newton, model.scales()), 1e-6) << more;
    EXPECT_EQ(integrator->statistics().factorization.count, 0);
    EXPECT_EQ(integrator->statistics().tangent.count, 0);
    EXPECT_EQ(integrator->factor_bytes(), 0u);
  }
}

TEST(CvodeAdams, ReachHighOrdersOnSmoothMotion) {
  const auto model = harmonic_oscillator();
  int highest = 0;
  integrate(model, *make(model, "{type: cvode_adams, rtol: 1e-11}"),
            [&](const StepInfo& info, const Integrator&) { highest = std::max(highest, info.order); });
  EXPECT_GT(highest, 5);
  EXPECT_LE(highest, 12);
}

TEST(CvodeAdams, RefuseKeysOfTheOtherIteration) {
  for (const std::string key : {"linear_solver: klu", "gauss_newton: true"}) {
    const auto message = reading_refusal("{type: cvode_adams, nonlinear: fixed_point, " + key + "}");
    EXPECT_NE(message.find("nonlinear: fixed_point; remove it"), std::string::npos) << message;
  }
  const auto message = reading_refusal("{type: cvode_adams, nonlinear: newton, anderson: 3}");
  EXPECT_NE(message.find("anderson: is not used with nonlinear: newton"), std::string::npos) << message;
}

}  // namespace
}  // namespace orthodyn::explicit_runge_kutta_test
