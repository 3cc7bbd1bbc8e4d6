// Every integrator with every linear solver against exact solutions.
#include "tests/contract/integrators.h"

namespace orthodyn::accuracy_test {
namespace {

class Accuracy : public testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(Registry, Accuracy, testing::ValuesIn(pairs_with("rtol")), pair_name);

template <class SomeModel>
void expect_orders(const SomeModel& model, const Pair& pair, double fraction = 1) {
  if (tested(pair.integrator).exact_if_linear) {
    for (const double rtol : {1e-3, 1e-5, 1e-7}) EXPECT_LE(largest_error(model, pair, {rtol}, fraction), 10 * rtol);
    return;
  }
  for (const auto& variant : tested(pair.integrator).variants)
    expect_order(variant.order, [&](double rtol) {
      return largest_error(model, pair, {rtol, variant.order}, fraction);
    });
}

TEST_P(Accuracy, OfAHarmonicOscillatorFallsWithTheTolerance) { expect_orders(harmonic_oscillator(), GetParam()); }
TEST_P(Accuracy, OfADampedOscillatorFallsWithTheTolerance) { expect_orders(damped_oscillator(), GetParam()); }
TEST_P(Accuracy, UnderASuddenLoadFallsWithTheTolerance) { expect_orders(bathes_two_masses(), GetParam()); }
TEST_P(Accuracy, BesideTheImaginaryAxisFallsWithTheTolerance) { expect_orders(fast_ringing(), GetParam()); }
TEST_P(Accuracy, OfAStiffPairFallsWithTheTolerance) {
  if (!tested(GetParam().integrator).stiff) GTEST_SKIP() << "not for stiff models";
  expect_orders(stiff_pair(), GetParam());
}
TEST_P(Accuracy, UnderAKinkedLoadFallsWithTheTolerance) { expect_orders(kinked_oscillator(), GetParam()); }
TEST_P(Accuracy, OfAChainFallsWithTheTolerance) { expect_orders(chain(false), GetParam()); }

TEST_P(Accuracy, OfAChainWithConsistentMassFallsWithTheTolerance) {
  if (refuses_consistent_mass(GetParam())) GTEST_SKIP() << "refused by design";
  expect_orders(chain(true), GetParam());
}

TEST_P(Accuracy, OfThePendulumsEnergyFallsWithTheTolerance) {
  if (tested(GetParam().integrator).keeps_energy) GTEST_SKIP() << "makes none";
  if (tested(GetParam().integrator).linear_only) GTEST_SKIP() << "serves linear models only";
  const auto model = pendulum();
  const double energy = model.energy(model.initial());
  const int order = tested(GetParam().integrator).variants.front().order;
  expect_order(order, [&](double rtol) {
    double largest = 0;
    integrate(model, *make_integrator(GetParam(), model, {rtol, order}),
              [&](const StepInfo& info, const Integrator& i) {
                State state;
                i.interpolate(info.t, state);
                largest = std::max(largest, std::abs(model.energy(state) - energy));
              });
    return largest;
  });
}

TEST_P(Accuracy, BetweenStepsFallsWithTheTolerance) {
  for (const double fraction : {0.3, 0.7}) expect_orders(damped_oscillator(), GetParam(), fraction);
}

// Dense output is as accurate as the ends of the step, also for steps much longer than damped fast vibrations. Methods
// without dense output step to their output times.
TEST_P(Accuracy, BetweenLongStepsIsThatOfTheSteps) {
  if (!tested(GetParam().integrator).stiff) GTEST_SKIP() << "not for stiff models";
  const auto model = stiff_pair();
  if (!make_integrator(GetParam(), model)->has_accurate_interpolation()) GTEST_SKIP() << "steps to its outputs";
  for (const double rtol : {1e-4, 1e-6, 1e-8}) {
    const double at_steps = largest_error(model, GetParam(), {rtol});
    for (const double fraction : {0.3, 0.7})
      EXPECT_LE(largest_error(model, GetParam(), {rtol}, fraction), 5 * std::max(at_steps, rtol)) << rtol;
  }
}

TEST_P(Accuracy, OfAnUnsymmetricModelFallsWithTheTolerance) {
  if (tested(GetParam().integrator).linear_only) GTEST_SKIP() << "serves linear models only";
  if (GetParam().solver != "none" && !solver_registry().at(GetParam().solver).takes_general)
    GTEST_SKIP() << "refused by design";
  expect_orders(CirculatoryModel(), GetParam());
}

// The step size does not follow a stiff component: 10^6 times the stiffness costs at most twice the
// steps.
TEST_P(Accuracy, OfTheStiffPairCostsNoMoreThanThatOfOneOscillator) {
  if (!tested(GetParam().integrator).stiff) GTEST_SKIP() << "not for stiff models";
  const auto stiff = stiff_pair();
  const LinearModel slow({.mass = scalar(1), .stiffness = scalar(1), .beta = 0.1, .start = Vector::Ones(1), .end = 6});
  const auto steps = [&](const SmallModel& model) {
    const auto integrator = make_integrator(GetParam(), model);
    integrate(model, *integrator);
    return integrator->statistics().steps;
  };
  EXPECT_LE(steps(stiff), 2 * steps(slow));
}

// A method of order p needs rtol^(-1/(p+1)) steps and rejects few, whichever scale controls the error. Detects error
// estimators of a wrong order and spurious errors.
TEST_P(Accuracy, CostsStepsAsTheOrderSays) {
  const auto& method = tested(GetParam().integrator);
  if (!method.has_one_estimator) GTEST_SKIP() << "varies its order, or estimates the error of another one";
  const int order = method.variants.front().order;
  for (const std::string decides :
       {", position_scale: 1e-3, velocity_scale: 3", ", position_scale: 1, velocity_scale: 3e-3"}) {
    const auto statistics = [&](double rtol) {
      const auto model = harmonic_oscillator();
      const auto integrator = make_integrator(GetParam(), model, {rtol, order, decides});
      integrate(model, *integrator);
      return integrator->statistics();
    };
    const double least = order == 1 ? 1e-4 : 1e-6;
    const Statistics loose = statistics(100 * least), tight = statistics(least);
    const double ratio = static_cast<double>(tight.steps) / static_cast<double>(loose.steps);
    EXPECT_NEAR(std::log(ratio) / std::log(100), 1.0 / (order + 1), 0.2 / (order + 1)) << decides;
    EXPECT_LE(tight.rejected_steps, 0.05 * static_cast<double>(tight.steps) + 3) << decides;
  }
}

// The result does not depend on the linear solver. `tipped`: allowed relative difference of the numbers of steps and
// iterations, and of the result in units of rtol, where round-off can change a decision.
struct Tipped {
  double counts = 0, result = 1e-3;
};

template <class SomeModel>
void expect_the_same_steps_with_all_solvers(const SomeModel& model, const Options& options, const Tipped& tipped = {}) {
  const auto expect_close = [&](long count, long first, const std::string& who) {
    EXPECT_LE(static_cast<double>(std::abs(count - first)), tipped.counts * static_cast<double>(first)) << who;
  };
  for (const auto& [name, method] : tested_methods()) {
    if (!method.stiff || (method.linear_only && !model.traits().linear)) continue;
    std::optional<State> first;
    long steps = 0, iterations = 0;
    for (const auto& pair : all_pairs()) {
      if (pair.integrator != name || pair.solver == "petsc") continue;
      const auto integrator = make_integrator(pair, model, options);
      const State last = integrate(model, *integrator);
      if (first) {
        expect_close(integrator->statistics().steps, steps, name + " " + pair.solver + ": steps");
        expect_close(integrator->statistics().newton_iterations, iterations, name + " " + pair.solver + ": iterations");
        EXPECT_LE(distance(last, *first, model.scales()), tipped.result * options.rtol) << name << " " << pair.solver;
      } else {
        first = last;
        steps = integrator->statistics().steps;
        iterations = integrator->statistics().newton_iterations;
      }
    }
  }
}

TEST(LinearSolvers, AllTakeTheSameStepsOnALinearModel) {
  for (const int order : {2, 5}) expect_the_same_steps_with_all_solvers(chain(false), {1e-5, order});
}

// The damped stiff part is only round-off, which can decide Newton's last iteration.
TEST(LinearSolvers, AllTakeNearlyTheSameStepsOnAStiffModel) {
  for (const int order : {2, 5}) expect_the_same_steps_with_all_solvers(stiff_pair(), {1e-5, order}, {0.2, 1});
}

// An iterative solver is only as accurate as Newton's method requires.
TEST(LinearSolvers, AnIterativeOneCostsNeitherAccuracyNorSteps) {
  for (const auto& pair : all_pairs()) {
    if (pair.solver != "petsc") continue;
    const Pair direct{pair.integrator, "cholesky"};
    const Options options{1e-5, 2};
    const auto steps = [&](const Pair& tried) {
      const auto model = chain(false);
      const auto integrator = make_integrator(tried, model, options);
      integrate(model, *integrator);
      return static_cast<double>(integrator->statistics().steps);
    };
    EXPECT_LE(steps(pair), 1.1 * steps(direct)) << pair.integrator;
    EXPECT_LE(largest_error(chain(false), pair, options), 1.5 * largest_error(chain(false), direct, options))
        << pair.integrator;
  }
}

// Corrections in single precision change the result by less than the tolerance of Newton's method, 0.1 rtol for
// cvode_bdf. At rtol 1e-5 they change the number of steps of arkode_dirk (422 or 424, at any tolerance of Newton's
// method), and with it the result by 6 rtol, a fiftieth of its error.
TEST(LinearSolvers, AllTakeTheSameStepsOnANonlinearModel) {
  expect_the_same_steps_with_all_solvers(pendulum(), {1e-4, 2}, {0, 0.1});
}

}  // namespace
}  // namespace orthodyn::accuracy_test
