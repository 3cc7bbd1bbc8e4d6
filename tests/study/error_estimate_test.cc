// The error estimate of runs with known errors.
#include "lib/simulation/error_estimate/error_estimate.h"

#include <gtest/gtest.h>

#include "lib/simulation/error_estimate/modal_solution.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn::error_estimate_test {
namespace {

const std::string kLinear = R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [3, 1, 1], order: 1}
materials: {m: {type: orthotropic_stable, density: 1000, young: [2e6, 2e5, 1e5], nu: 0.3}}
elasticity: {kinematics: linear}
damping: {stiffness: 0.001, mass: 2}
clamps: [{surface: x0}]
initial: {velocity: [0.1, 0, 0.3]}
time: {end: 1}
)";

struct Estimated {
  explicit Estimated(const std::string& integrator, int outputs = 60)
      : setup(set_up(Config::from_text(kLinear + "integrator: " + integrator + "\n"))),
        plan{setup.scene.time.end, evenly_spaced(0, 1, outputs), false} {
    ErrorEstimator estimator(setup, plan);
    TrajectoryRecorder own(plan.output_times.size());
    run(*setup.built.model, *setup.integrator, setup.built.initial, plan, {&estimator.recorder(), &own}, never);
    estimate = estimator.estimate({}, never);
    trajectory = own.trajectory();
  }

  // Against the exact solution.
  TrajectoryErrors true_errors() const {
    const auto exact = ModalSolution::find(*setup.built.model, setup.built.initial);
    TrajectoryRecorder recorder(plan.output_times.size());
    const auto& model = *setup.built.model;
    recorder.on_start({model, setup.built.initial});
    for (const double t : plan.output_times) {
      const State state = exact->at(t);
      recorder.on_output({model, state});
    }
    return ReferenceNorms(*setup.built.model, recorder.trajectory(), {}).errors(trajectory);
  }

  std::atomic<bool> never{false};
  Setup setup;
  Plan plan;
  ErrorEstimate estimate;
  Trajectory trajectory;
};

void expect_within(double factor, const ErrorNorms& estimate, const ErrorNorms& truth) {
  for (const auto& [e, t] : {std::pair{estimate.l2, truth.l2}, {estimate.max, truth.max}}) {
    EXPECT_GT(e, t / factor);
    EXPECT_LT(e, t * factor);
  }
}

class Integrators : public testing::TestWithParam<const char*> {};

TEST_P(Integrators, TheEstimateIsWithinAFactorOfThreeOfTheTrueError) {
  const Estimated run(GetParam());
  ASSERT_TRUE(run.estimate.completed) << run.estimate.failure_reason;
  const auto truth = run.true_errors();
  EXPECT_GT(truth.displacement.l2, 1e-9);  // there is an error
  expect_within(3, run.estimate.displacement, truth.displacement);
  expect_within(3, run.estimate.velocity, truth.velocity);
}

INSTANTIATE_TEST_SUITE_P(ErrorEstimate, Integrators,
                         testing::Values("{type: cvode_bdf, rtol: 1e-3}", "{type: cvode_bdf, rtol: 1e-6}",
                                         "{type: ida_bdf, rtol: 1e-4}", "{type: arkode_dirk, rtol: 1e-4}",
                                         "{type: arkode_dirk, step: 0.01, rtol: 1e-8}", "{type: central_differences}",
                                         "{type: auto, method: central_differences, safety: 0.5}"));

// At order 2 the plain difference is three quarters of the error.
TEST(ErrorEstimate, RichardsonIsExactToLeadingOrderForAFixedStep) {
  const Estimated run("{type: arkode_dirk, table: TRBDF2_3_3_2, step: 0.002, rtol: 1e-9}");
  EXPECT_NEAR(run.estimate.displacement.l2 / run.true_errors().displacement.l2, 1, 0.1);
}

TEST(ErrorEstimate, ThousandsOfOutputsAreSampledUpToTheLast) {
  const Estimated run("{type: cvode_bdf, rtol: 1e-4}", 1001);
  EXPECT_EQ(run.estimate.samples, 1 + 167);  // every sixth of 1001, and the last
  EXPECT_NEAR(
      run.estimate.displacement.final / Estimated("{type: cvode_bdf, rtol: 1e-4}", 10).estimate.displacement.final, 1,
      0.05);
}

TEST(ErrorEstimate, StepsMayHaveAUnit) {
  const Estimated plain("{type: arkode_dirk, step: 0.01, rtol: 1e-8}"),
      with_unit("{type: arkode_dirk, step: 10 ms, rtol: 1e-8}");
  EXPECT_EQ(with_unit.estimate.against, "integrator.step=0.005");
  EXPECT_EQ(with_unit.estimate.displacement.l2, plain.estimate.displacement.l2);
}

// Two runs with q and v each, in doubles.
TEST(ErrorEstimate, TakesFewerSamplesOfALargeModel) {
  EXPECT_EQ(samples_within(1e9, 600), 200u);
  for (const std::size_t dofs : {200'000u, 600'000u, 5'000'000u}) {
    const double bytes = 2.0 * 2 * 8 * static_cast<double>(dofs) * static_cast<double>(samples_within(1e9, dofs));
    EXPECT_LE(bytes, 1e9);
    EXPECT_GT(bytes, 0.8e9);
  }
  EXPECT_EQ(samples_within(1e9, 1'000'000'000), 2u);  // some, whatever it takes
}

TEST(ErrorEstimate, ARefinedValueThatIsRefusedIsRefusedBeforeTheRun) {
  // A tenth of the smallest allowed tolerance is not allowed.
  const auto setup = set_up(Config::from_text(kLinear + "integrator: {type: arkode_dirk, step: 0.01, rtol: 1e-14}\n"));
  EXPECT_THROW(ErrorEstimator(setup, Plan{1, {0.5, 1}, false}), ConfigError);
}

TEST(ErrorEstimate, HasNothingToSayWithoutOutputs) {
  const auto setup = set_up(Config::from_text(kLinear));
  EXPECT_THROW(ErrorEstimator(setup, Plan{1, {}, false}), ConfigError);
}

}  // namespace
}  // namespace orthodyn::error_estimate_test
