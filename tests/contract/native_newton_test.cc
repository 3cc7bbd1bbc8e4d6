// Newton's method in the native implicit methods: number of matrices, and treatment of failures.
#include "tests/contract/integrators.h"

namespace orthodyn::native_newton_test {
namespace {

std::unique_ptr<Integrator> make(const SmallModel& model, const std::string& options) {
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{type: " + options + "}"));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), 1});
}

Statistics run(const SmallModel& model, const std::string& options) {
  const auto integrator = make(model, options);
  integrate(model, *integrator);
  return integrator->statistics();
}

TEST(NativeNewton, MakesNoMatrixTwiceForALinearModelWithAFixedStep) {
  const auto model = harmonic_oscillator();  // 60 steps
  for (const std::string method : {"newmark", "hht_alpha", "tr_bdf2", "sdirk", "backward_euler"})
    for (const std::string kind : {"lazy", "modified", "full"}) {
      const auto s = run(model, method + ", step: 0.1, newton: " + kind);
      EXPECT_EQ(s.tangent.count, 1) << method << " " << kind;
      EXPECT_LE(s.factorization.count, 2) << method << " " << kind;  // the last step may differ by round-off
    }
}

TEST(NativeNewton, RenewsItsMatrixAsOftenAsItsKindSays) {
  const auto model = pendulum();  // 250 steps
  const auto lazy = run(model, "newmark, step: 0.02, newton: lazy");
  const auto modified = run(model, "newmark, step: 0.02, newton: modified");
  const auto full = run(model, "newmark, step: 0.02, newton: full");
  EXPECT_LT(lazy.factorization.count, 150);
  EXPECT_GE(modified.factorization.count, 250);
  EXPECT_EQ(full.factorization.count, full.newton_iterations);
  EXPECT_LE(full.newton_iterations, modified.newton_iterations);
}

TEST(NativeNewton, KindsReachTheSameEnd) {
  const auto model = pendulum();
  const auto end = [&](const std::string& kind) {
    return integrate(model, *make(model, "generalized_alpha, rtol: 1e-9, step: 0.02, newton: " + kind));
  };
  const State lazy = end("lazy");
  for (const std::string kind : {"modified", "full"}) EXPECT_LE(distance(end(kind), lazy, {1, 20}), 1e-8) << kind;
}

// A hardening spring: from a distant start, one iteration of full Newton does not converge at this step size.
TEST(NativeNewton, WithoutASolutionAFixedStepIsHalvedAndCounted) {
  const auto model = pendulum();
  const auto integrator = make(model, "newmark, step: 0.25, max_newton_iterations: 2");
  long steps = 0;
  integrate(model, *integrator, [&](const StepInfo& info, const Integrator&) {
    EXPECT_NEAR(info.h, 0.25, 1e-12);
    ++steps;
  });
  EXPECT_EQ(steps, 20);
  EXPECT_EQ(integrator->statistics().steps, 20);
  EXPECT_GT(integrator->statistics().convergence_failures, 0);
  EXPECT_EQ(integrator->statistics().rejected_steps, integrator->statistics().convergence_failures);
}

TEST(NativeNewton, ThatNeverConvergesEndsInARunErrorWithTheRemedy) {
  const auto model = pendulum();
  const auto integrator = make(model, "newmark, rtol: 1e-9, step: 0.5, max_newton_iterations: 1");
  try {
    integrate(model, *integrator);
    FAIL() << "converged";
  } catch (const RunError& e) {
    EXPECT_EQ(e.reason(), Reason::newton);
    const std::string message = e.what();
    EXPECT_NE(message.find("newmark stopped at t = 0 s, step 0.5 s: Newton's method does not converge"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("lower integrator.step"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace orthodyn::native_newton_test
