// Methods that integrate constraints: orders of positions, velocities and multipliers, by the tolerance and by fixed
// steps, compared with a fine solution by another method (constrained_models.h); restarts, drift, refused inputs.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/contract/constrained_models.h"
#include "tests/contract/integrators.h"

namespace orthodyn::constraints_test {
namespace {

struct Method {
  std::string type;
  int order;
  std::string options = "";  // ", key: value"
};
void PrintTo(const Method& m, std::ostream* os) { *os << m.type << m.options; }
std::string method_name(const testing::TestParamInfo<Method>& tested) {
  return fmt::format("{}_{}", tested.param.type, tested.param.order);
}

std::unique_ptr<Integrator> make(const SmallModel& model, const std::string& yaml) {
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{type: " + yaml + "}"));
  return choice->make(model, {[&] { return model.scales(); }, model.initial(), model.end(), model.end() / 50});
}

std::string refusal(const SmallModel& model, const std::string& yaml) {
  try {
    make(model, yaml);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

// The second half of a motion, where initial errors of multipliers have decayed.
std::vector<double> checkpoints(const SmallModel& model) {
  std::vector<double> times;
  for (const double share : {0.5, 0.63, 0.71, 0.86, 1.0}) times.push_back(share * model.end());
  return times;
}

struct Errors {
  double motion = 0, multipliers = 0;  // relative to the scales and to the largest multiplier
  double gap = 0, rate = 0;            // largest |g| and |dg/dt| at the ends of steps
  long steps = 0, rejected = 0;
};

Errors errors_of(const PivotedModel& model, const std::vector<State>& exact, const std::string& yaml) {
  Errors out;
  double largest = 0;
  for (const State& s : exact) largest = std::max(largest, std::abs(s.lambda[0]));
  const auto integrator = make(model, yaml);
  std::size_t next = 0;
  State state;
  Vector g(1);
  integrate(model, *integrator, [&](const StepInfo& info, const Integrator& i) {
    for (; next < exact.size() && exact[next].t <= info.t; ++next) {
      i.interpolate(exact[next].t, state);
      out.motion = std::max(out.motion, distance(state, exact[next], model.scales()));
      out.multipliers = std::max(out.multipliers, std::abs(state.lambda[0] - exact[next].lambda[0]) / largest);
    }
    i.interpolate(info.t, state);
    model.values(state.t, state.q, g);
    out.gap = std::max(out.gap, std::abs(g[0]));
    model.rates(state.t, state.q, state.v, g);
    out.rate = std::max(out.rate, std::abs(g[0]));
  });
  EXPECT_EQ(next, exact.size());
  out.steps = integrator->statistics().steps;
  out.rejected = integrator->statistics().rejected_steps;
  return out;
}

const SphericalPendulum& free_pendulum() {
  static const SphericalPendulum model;
  return model;
}
const SphericalPendulum& shaken_pendulum() {
  static const SphericalPendulum model(0.1);
  return model;
}
const StiffPendulum& stiff_pendulum() {
  static const StiffPendulum model;
  return model;
}

// Each model with its exact motion.
const std::vector<std::pair<const PivotedModel*, std::vector<State>>>& motions() {
  static const auto all = [] {
    std::vector<std::pair<const PivotedModel*, std::vector<State>>> list;
    const auto add = [&](const PivotedModel& model, double step) {
      list.emplace_back(&model, fine_motion(model, checkpoints(model), step));
    };
    add(free_pendulum(), 1e-3);
    add(shaken_pendulum(), 1e-3);
    add(stiff_pendulum(), 1e-4);
    return list;
  }();
  return all;
}

TEST(FineMotion, KeepsEnergyMomentumAndConstraints) {
  const auto& model = free_pendulum();
  const State start = model.initial();
  for (const State& s : motions()[0].second) {
    EXPECT_NEAR(model.energy(s), model.energy(start), 1e-9);
    EXPECT_NEAR(s.q[0] * s.v[1] - s.q[1] * s.v[0], start.q[0] * start.v[1], 1e-10);
  }
  for (const auto& [moved, states] : motions())
    for (const State& s : states) {
      Vector g(1);
      moved->values(s.t, s.q, g);
      EXPECT_LE(std::abs(g[0]), 1e-9);
      moved->rates(s.t, s.q, s.v, g);
      EXPECT_LE(std::abs(g[0]), 1e-8);
    }
}

class Constrained : public testing::TestWithParam<Method> {
 protected:
  std::string yaml(const std::string& more) const { return GetParam().type + GetParam().options + ", " + more; }
  Errors errors(std::size_t motion, const std::string& more) const {
    const auto& [model, exact] = motions()[motion];
    return errors_of(*model, exact, yaml(more));
  }
};

// Methods with a fixed step.
class ConstrainedSteps : public Constrained {
 protected:
  bool is_explicit() const { return GetParam().type == "central_differences"; }
  Errors errors_with_step(std::size_t motion, double step) const {
    return errors(motion, fmt::format("{}step: {}", is_explicit() ? "" : "rtol: 1e-12, ", step));
  }
  // Explicit methods need steps below the critical one.
  double largest_step(std::size_t motion) const {
    return (is_explicit() ? 0.003 : 0.01) * motions()[motion].first->end();
  }
};

const Method kNewmark{"newmark", 1, ", beta: 0.5, gamma: 0.7"};
INSTANTIATE_TEST_SUITE_P(Methods, Constrained,
                         testing::Values(Method{"ida_bdf", 2, ", max_order: 2"}, Method{"ida_bdf", 5, ", max_order: 5"},
                                         Method{"cvode_bdf", 2, ", max_order: 2"},
                                         Method{"cvode_bdf", 5, ", max_order: 5"}, Method{"generalized_alpha", 2},
                                         Method{"hht_alpha", 2}, kNewmark),
                         method_name);
INSTANTIATE_TEST_SUITE_P(Methods, ConstrainedSteps,
                         testing::Values(Method{"generalized_alpha", 2}, Method{"hht_alpha", 2}, kNewmark,
                                         Method{"central_differences", 2}),
                         method_name);

TEST_P(Constrained, MotionFallsWithTheTolerance) {
  for (std::size_t k = 0; k < motions().size(); ++k)
    expect_order(GetParam().order, [&](double rtol) { return errors(k, fmt::format("rtol: {}", rtol)).motion; });
}

TEST_P(Constrained, MultipliersFallWithTheTolerance) {
  for (std::size_t k = 0; k < motions().size(); ++k)
    expect_order(GetParam().order, [&](double rtol) { return errors(k, fmt::format("rtol: {}", rtol)).multipliers; });
}

TEST_P(Constrained, FewStepsAreRejected) {
  for (const double rtol : {1e-5, 1e-7, 1e-9}) {
    const Errors e = errors(0, fmt::format("rtol: {}", GetParam().order == 1 ? 100 * rtol : rtol));
    EXPECT_LE(e.rejected, 3 + e.steps / 50) << rtol;
  }
}

TEST_P(Constrained, PositionsSatisfyTheConstraints) {
  for (std::size_t k = 0; k < motions().size(); ++k)
    for (const double rtol : {1e-4, 1e-6}) EXPECT_LE(errors(k, fmt::format("rtol: {}", rtol)).gap, rtol) << k;
}

TEST_P(Constrained, VelocitiesOfMultistepMethodsSatisfyTheConstraints) {
  if (has_key(GetParam().type, "step")) GTEST_SKIP() << "violates them by h^2";
  for (std::size_t k = 0; k < motions().size(); ++k)
    for (const double rtol : {1e-4, 1e-6})
      EXPECT_LE(errors(k, fmt::format("rtol: {}", rtol)).rate, rtol * motions()[k].first->scales().velocity) << k;
}

// The observed order of an error for steps from h.
template <class Error>
double observed_order(double h, const Error& error) {
  constexpr int kHalvings = 4;
  std::vector<double> steps, all;
  for (int k = 0; k <= kHalvings; ++k) {
    steps.push_back(std::ldexp(h, -k));
    all.push_back(error(steps.back()));
  }
  return slope(steps, all);
}

TEST_P(ConstrainedSteps, HaveTheirOrderInAllUnknowns) {
  const double order = GetParam().order;
  for (std::size_t k = 0; k < motions().size(); ++k) {
    const double h = largest_step(k);
    const auto run = [&](double step) { return errors_with_step(k, step); };
    EXPECT_NEAR(observed_order(h, [&](double step) { return run(step).motion; }), order, 0.15) << k;
    EXPECT_NEAR(observed_order(h, [&](double step) { return run(step).multipliers; }), order, 0.25) << k;
  }
}

// Velocities along the constraints have the error C h^2 q''' (Arnold & Bruels 2007), also with methods of order 1.
TEST_P(ConstrainedSteps, VelocitiesViolateTheConstraintsBySquaresOfTheStep) {
  for (std::size_t k = 0; k < motions().size(); ++k) {
    const auto rate = [&](double step) { return errors_with_step(k, step).rate; };
    if (is_explicit()) EXPECT_LE(rate(largest_step(k)), 1e-12);
    else EXPECT_NEAR(observed_order(largest_step(k), rate), 2, 0.2) << k;
  }
}

// The pivot moves at the speed p': it does the work -lambda r . p'.
TEST_P(ConstrainedSteps, MeanStatesTellTheWorkOfAMovedPivot) {
  if (GetParam().order < 2) GTEST_SKIP() << "damps the motion itself";
  if (is_explicit()) GTEST_SKIP() << "integrates powers along its dense output";
  const auto& model = shaken_pendulum();
  const auto imbalance = [&](double step) {
    const auto integrator = make(model, yaml(fmt::format("rtol: 1e-12, step: {}", step)));
    double work = 0;
    const State last = integrate(model, *integrator, [&](const StepInfo& info, const Integrator& i) {
      const State mean = *i.mean_state();
      const Eigen::SparseMatrix<double> G = model.jacobian(mean.t, mean.q);
      Vector g_rate(1);
      model.rates(mean.t, mean.q, mean.v, g_rate);
      work += info.h * mean.lambda[0] * (g_rate[0] - Vector(G.col(0)).dot(mean.v));
    });
    return std::abs(model.energy(last) - model.energy(model.initial()) - work);
  };
  EXPECT_NEAR(observed_order(0.02, imbalance), 2, 0.3);
}

// Three hundred swings. The largest change of the energy within some swings does not grow, and falls with h^2.
TEST(ConstrainedCentralDifferences, KeepTheEnergyForALongTime) {
  class Swinging : public SphericalPendulum {
   public:
    double end() const override { return 600; }
  };
  const Swinging model;
  const auto changes = [&](double step) {
    const auto integrator = make(model, fmt::format("central_differences, step: {}", step));
    double early = 0, late = 0;
    State state;
    integrate(model, *integrator, [&](const StepInfo& info, const Integrator& i) {
      i.interpolate(info.t, state);
      const double change = std::abs(model.energy(state) - model.energy(model.initial()));
      if (info.t < 0.05 * model.end()) early = std::max(early, change);
      if (info.t > 0.95 * model.end()) late = std::max(late, change);
    });
    return std::pair(early, late);
  };
  const auto [early, late] = changes(0.02);
  EXPECT_LE(late, 1.05 * early);
  EXPECT_NEAR(changes(0.01).second / late, 0.25, 0.02);
}

// A model whose motion is restarted, as after events.
class Restarted : public SphericalPendulum {
 public:
  Restarted() : SphericalPendulum(0.1) {}
  std::vector<double> breakpoints(double, double) const override { return {0.301, 0.65}; }
};

// Single errors jump by a factor of 3 with the steps (order.h).
TEST_P(Constrained, RestartsKeepTheAccuracy) {
  const Restarted model;
  const auto& exact = motions()[1].second;
  const double rtol = GetParam().order == 1 ? 1e-5 : 1e-6;
  const std::string with = yaml(fmt::format("rtol: {}", rtol));
  const Errors whole = errors_of(shaken_pendulum(), exact, with), parts = errors_of(model, exact, with);
  EXPECT_LE(parts.motion, 5 * whole.motion);
  EXPECT_LE(parts.multipliers, 5 * whole.multipliers);
}

// Initial velocities are made to fit.
TEST_P(Constrained, StartsWithTheTensionOfTheStart) {
  const auto& model = free_pendulum();
  const auto integrator = make(model, yaml("rtol: 1e-6"));
  State start = model.initial(), first;
  start.v += 0.3 * start.q;  // along the rod
  integrator->start(start);
  integrator->step(1);
  State expected = fine_motion(model, {0}, 1)[0];
  integrator->interpolate(0, first);
  EXPECT_LE(distance(first, expected, model.scales()), 1e-9);
  // m v^2 / L + m g cos(angle)
  EXPECT_NEAR(first.lambda[0], 2 * (1.5 * 1.5 + PivotedModel::kGravity * std::cos(1.0)), 1e-6);
}

TEST(ConstrainedMethods, OthersAreRefusedByName) {
  for (const auto& [name, method] : tested_methods()) {
    const auto choice = Registry<IntegratorChoice>::entries().at(name).make();
    if (choice->solves_constraints() || method.linear_only) continue;
    const std::string step = controls_its_error(name) ? "" : ", step: 0.01";
    EXPECT_THAT(refusal(free_pendulum(), name + method.needs + step),
                testing::HasSubstr("use ida_bdf, cvode_bdf, generalized_alpha"))
        << name;
  }
}

TEST(ConstrainedMethods, ThatKeepTheFastestOscillationsAreRefused) {
  for (const char* with : {"newmark", "newmark, beta: 0.35, gamma: 0.7", "hht_alpha, alpha: 0",
                           "generalized_alpha, rho_inf: 1", "generalized_alpha, rho_inf: 1, step: 0.01"}) {
    EXPECT_THAT(refusal(free_pendulum(), with), testing::HasSubstr("damps the fastest oscillations")) << with;
    EXPECT_NO_THROW(make(harmonic_oscillator(), with)) << with;
  }
}

// The auxiliary acceleration of these methods cannot be extrapolated to a much longer step, whose error would be so
// large that the next one is as short as before.
TEST(ConstrainedMethods, StepsDoNotGrowAndShrinkInTurn) {
  for (const double rho : {0.0, 0.3, 0.5})
    for (const double rtol : {3e-9, 1e-9}) {
      const auto integrator = make(free_pendulum(), fmt::format("generalized_alpha, rho_inf: {}, rtol: {}", rho, rtol));
      integrate(free_pendulum(), *integrator);
      const Statistics& all = integrator->statistics();
      EXPECT_LE(all.rejected_steps, 3 + all.steps / 50) << rho << ", " << rtol;
    }
}

// A spring of 14,000 rad/s, whose force changes by ten times the largest multiplier if its length changes by the
// tolerance.
TEST(ConstrainedMethods, MultipliersAreAccurateBesideStiffBodies) {
  const StiffPendulum model(1e8, 1e4);
  const auto fine = make(model, "ida_bdf, rtol: 1e-9");
  std::vector<State> exact;
  const auto times = checkpoints(model);
  integrate(model, *fine, [&](const StepInfo& info, const Integrator& i) {
    for (State state; exact.size() < times.size() && times[exact.size()] <= info.t;) {
      i.interpolate(times[exact.size()], state);
      exact.push_back(state);
    }
  });
  for (const char* type : {"ida_bdf", "cvode_bdf", "generalized_alpha", "hht_alpha"})
    EXPECT_LE(errors_of(model, exact, fmt::format("{}, rtol: 1e-4", type)).multipliers, 0.05) << type;
}

TEST(ConstrainedCentralDifferences, NeedAStepWithoutStiffness) {
  EXPECT_THAT(refusal(free_pendulum(), "central_differences"), testing::HasSubstr("set a step"));
  EXPECT_EQ(refusal(stiff_pendulum(), "central_differences"), "");
}

TEST(ConstrainedMethods, KluFullIsRefused) {
  for (const char* type : {"ida_bdf", "cvode_bdf"})
    EXPECT_THAT(refusal(free_pendulum(), std::string(type) + ", linear_solver: klu_full"),
                testing::HasSubstr("klu_full is not available with joints"));
}

}  // namespace
}  // namespace orthodyn::constraints_test
