#include "lib/simulation/run_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lib/linear/solver.h"
#include "lib/simulation/setup.h"
#include "lib/simulation/volume.h"

namespace orthodyn {

namespace {

constexpr double kLargestFactor = 2e9;  // bytes of one that is tried for the sake of a figure: some ten seconds

// Of an adaptive implicit method, measured on the scenes of configs/: forces and solutions for each step, tangents with
// their factors for each, and steps for each radian of the motion at rtol 1e-3.
constexpr double kIterations = 4, kFewestTangents = 0.05, kMostTangents = 1, kSteps = 7;
constexpr double kSpread = 5;           // of the number of steps, to both sides
constexpr double kScaleOfMotion = 0.1;  // a position scale is about a tenth of the motion
constexpr double kUsualSafety = 0.9;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// A factor of M/h^2 + K with h the time of a wave through an element: it costs the same for any h.
void measure_factor(const Setup& setup, RunCost& cost) {
  const FemModel& model = *setup.built.model;
  const State& initial = setup.built.initial;
  Linearization at;
  model.linearize(initial.t, initial.q, initial.v, TangentKind::gauss_newton, at);
  std::vector<double> values(at.stiffness.size());
  model.combine({model.frequency_bound() * model.frequency_bound(), 0, 1}, at, values.data());
  const auto solver = solver_registry().at(model.pattern().symmetric ? "cholmod" : "klu").make();
  solver->analyze(model.pattern());
  if (static_cast<double>(solver->factor_bytes()) > kLargestFactor) return;
  auto begin = std::chrono::steady_clock::now();
  if (solver->factor(values.data()) != FactorStatus::ok) return;
  cost.factor = seconds_since(begin);
  Vector x = Vector::Ones(model.num_dofs());
  begin = std::chrono::steady_clock::now();
  solver->solve(Vector(x), x);
  cost.solve = seconds_since(begin);
}

// Cycles of the motion, as radians.
double phase_of(const Setup& setup) {
  const Scales scales = task_of(setup.scene, setup.built).scales();
  const double omega = std::max(scales.omega, kScaleOfMotion * scales.velocity / scales.position);
  return omega * (setup.scene.time.end - setup.scene.time.start);
}

CostRange steps_of(const Setup& setup, bool is_implicit, RunCost& cost) {
  const double span = setup.scene.time.end - setup.scene.time.start;
  const IntegratorSettings settings = setup.scene.integrator->settings();
  if (settings.step) {
    cost.fixed_steps = true;
    return {std::ceil(span / *settings.step), std::ceil(span / *settings.step)};
  }
  if (!is_implicit) {  // the bound of the frequency is above it by up to two
    const double most = span * setup.built.model->frequency_bound() / 2 / settings.safety.value_or(kUsualSafety);
    return {most / 2, most};
  }
  const double about = 10 + kSteps * phase_of(setup) * std::cbrt(1e-3 / settings.rtol.value_or(1e-3));
  const auto two_digits = [](double x) {
    const double unit = std::pow(10, std::floor(std::log10(x)) - 1);
    return std::round(x / unit) * unit;
  };
  const double fewest = settings.h_max ? span / *settings.h_max : 1;
  return {two_digits(std::max(about / kSpread, fewest)), two_digits(std::max(about * kSpread, fewest))};
}

// Load steps that are doubled from the first one on; each takes a few Newton corrections with a factor each.
void add_load_steps(const Statics& statics, RunCost& cost) {
  constexpr double kFewestCorrections = 3, kMostCorrections = 8, kMostCuts = 10;
  const double each = cost.force + cost.tangent + cost.factor.value_or(0) + cost.solve.value_or(0);
  cost.step = {kFewestCorrections * each, kMostCorrections * each};
  const double fewest = fewest_load_steps(statics);
  cost.steps = {fewest, std::min(kMostCuts * fewest, static_cast<double>(statics.max_steps))};
}

// One computation: the stiffness, what stresses add to it from four tangents more, three factors and Lanczos'
// solutions.
void add_buckling(RunCost& cost) {
  constexpr double kTangents = 6, kFactors = 3, kFewestSolutions = 50, kMostSolutions = 500;
  const double fixed = kTangents * cost.tangent + kFactors * cost.factor.value_or(0);
  cost.step = {fixed + kFewestSolutions * cost.solve.value_or(0), fixed + kMostSolutions * cost.solve.value_or(0)};
  cost.steps = {1, 1};
}

}  // namespace

RunCost run_cost(const Setup& setup, const std::vector<TermCost>& costs) {
  RunCost cost;
  for (const TermCost& term : costs) cost.force += term.force, cost.tangent += term.tangent;
  const bool is_static = !setup.integrator, is_implicit = is_static || setup.integrator->factor_bytes() > 0;
  if (is_implicit) measure_factor(setup, cost);
  if (is_static) {
    setup.scene.buckling ? add_buckling(cost) : add_load_steps(*setup.scene.statics, cost);
    return cost;
  }
  if (is_implicit) {
    const double each = kIterations * (cost.force + cost.solve.value_or(0));
    const double anew = cost.tangent + cost.factor.value_or(0);
    const double fewest = setup.built.model->traits().linear ? 0 : kFewestTangents;
    cost.step = {each + fewest * anew, each + kMostTangents * anew};
  } else {
    cost.step = {cost.force, 2 * cost.force};  // with what is written and summed up beside
  }
  cost.steps = steps_of(setup, is_implicit, cost);
  return cost;
}

std::string shown_seconds(const CostRange& range) {
  const auto& [size, unit] = [&]() -> std::pair<double, const char*> {
    if (range.most >= 2 * 86400) return {86400, "days"};
    if (range.most >= 2 * 3600) return {3600, "h"};
    if (range.most >= 120) return {60, "min"};
    return {1, "s"};
  }();
  return fmt::format("{:.3g} to {:.3g} {}", range.least / size, range.most / size, unit);
}

}  // namespace orthodyn
