#include "lib/simulation/preflight/run_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lib/fem/terms/added_term.h"
#include "lib/linear/solver.h"
#include "lib/simulation/output/run_observers.h"
#include "lib/simulation/preflight/output_size.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

namespace {

constexpr double kLargestFactor = 2e9;  // bytes; a larger factorisation takes over 10 s and is not measured

// Adaptive implicit methods, measured on configs/: Newton iterations and tangents (with factorisation) per step, and
// steps per radian of the motion at rtol 1e-3.
constexpr double kIterations = 4, kFewestTangents = 0.05, kMaxTangents = 1, kSteps = 7;
constexpr double kStepsOfCreep = 50;    // without vibrations
constexpr double kSpread = 5;           // uncertainty of the number of steps, as a factor
constexpr double kScaleOfMotion = 0.1;  // position scale over the amplitude of the motion
constexpr double kUsualSafety = 0.9;
constexpr double kSpreadOfContact = 15;   // upper uncertainty factor with contact, whose duration is unknown
constexpr double kStepsBeforeEvent = 10;  // until an event may end the run

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Measures the factorisation of M/h^2 + K, where h is the time that a wave takes through an element. The cost does not
// depend on h.
void measure_factor(const Setup& setup, RunCost& cost) {
  const FemModel& model = *setup.built.model;
  const State& initial = setup.built.initial;
  Linearization at;
  model.linearize(initial.t, initial.q, initial.v, TangentKind::gauss_newton, at);
  std::vector<double> values(at.stiffness.size());
  model.combine({model.frequency_bound() * model.frequency_bound(), 0, 1}, at, values.data());
  const auto wanted = setup.scene.integrator ? setup.scene.integrator->settings().linear_solver : std::nullopt;
  const bool has_own = wanted && solver_registry().at(wanted->type).make;  // klu_full belongs to SUNDIALS
  const auto solver = has_own ? make_linear_solver(*wanted) : make_solver_for(model.pattern());
  if (has_own) solver->analyze(model.pattern());
  if (static_cast<double>(solver->factor_bytes()) > kLargestFactor) return;
  auto begin = std::chrono::steady_clock::now();
  if (solver->factor(values.data()) != FactorStatus::ok) return;
  cost.factor = seconds_since(begin);
  Vector x = Vector::Ones(model.num_dofs());
  begin = std::chrono::steady_clock::now();
  try {
    solver->solve(Vector(x), x);
  } catch (const RecoverableError&) {  // cost.solve stays empty
    return;
  }
  cost.solve = seconds_since(begin);
}

bool has_contact(const FemModel& model) {
  const auto& loads = model.parts().loads;
  return std::any_of(loads.begin(), loads.end(), [](const auto& term) { return term->contact() != nullptr; });
}

// Bodies that relax or swell often move far more slowly than they vibrate.
bool may_creep(const FemModel& model) {
  const auto& loads = model.parts().loads;
  const bool swells = std::any_of(loads.begin(), loads.end(), [](const auto& term) {
    return term->is_load() && dynamic_cast<const AddedTerm*>(term.get());
  });
  return model.internal_variables() || (swells && model.traits().time_dependent);
}

bool may_end_early(const Scene& scene) {
  return std::any_of(scene.events.begin(), scene.events.end(),
                     [](const EventSpec& event) { return event.action == EventAction::stop; });
}

// Approximate number of steps of an adaptive implicit method, from the phase of the motion in radians.
double steps_for(const Setup& setup, const Scales& scales) {
  const double omega = std::max(scales.omega, kScaleOfMotion * scales.velocity / scales.position);
  const double phase = omega * (setup.scene.time.end - setup.scene.time.start);
  return 10 + kSteps * phase * std::cbrt(1e-3 / setup.scene.integrator->settings().rtol.value_or(1e-3));
}

// For a scene with contact, `about` is the number of steps if the body were always in contact (position scale: depth of
// contact), and `fewest` the number if it never were (position scale: a tenth of the extent). Measured numbers of steps
// lie near the geometric mean of the two.
CostRange adaptive_steps(const Setup& setup) {
  const Scales scales = task_of(setup.scene, setup.built).scales();
  const double about = steps_for(setup, scales);
  if (!has_contact(*setup.built.model)) return {about / kSpread, about * kSpread};
  Scales apart = scales;
  apart.position = std::max(scales.position, 0.1 * bounding_box(setup.built.model->parts().mesh).size().maxCoeff());
  const double fewest = steps_for(setup, apart);
  return {fewest / kSpread, std::sqrt(fewest * about) * kSpreadOfContact};
}

// Steps of `modal`: one or two with constant loads, 50 to 1000 with time-dependent ones.
CostRange steps_of_modes(const FemModel& model) {
  constexpr double kFewest = 50, kMax = 1000;
  return model.traits().time_dependent ? CostRange{kFewest, kMax} : CostRange{1, 2};
}

CostRange steps_of(const Setup& setup, bool is_implicit, RunCost& cost) {
  const double span = setup.scene.time.end - setup.scene.time.start;
  const IntegratorSettings settings = setup.scene.integrator->settings();
  if (settings.step) {
    cost.fixed_steps = true;
    return {std::ceil(span / *settings.step), std::ceil(span / *settings.step)};
  }
  if (!is_implicit) {  // the bound is one to two times the highest frequency
    const double most = span * setup.built.model->frequency_bound() / 2 / settings.safety.value_or(kUsualSafety);
    return {most / 2, most};
  }
  const CostRange about = adaptive_steps(setup);
  const auto two_digits = [](double x) {
    const double unit = std::pow(10, std::floor(std::log10(x)) - 1);
    return std::round(x / unit) * unit;
  };
  const double fewest = settings.h_max ? span / *settings.h_max : 1;
  double least = cost.may_end_early ? std::min(about.least, kStepsBeforeEvent) : std::max(about.least, fewest);
  if (cost.may_creep) least = std::max(std::min(least, kStepsOfCreep), fewest);
  return {two_digits(least), two_digits(std::max(about.most, fewest))};
}

// Load steps double in size from the first one. Each takes a few Newton iterations with a factorisation each.
void add_load_steps(const Statics& statics, RunCost& cost) {
  constexpr double kFewestCorrections = 3, kMaxCorrections = 8, kMaxCuts = 10;
  const double each = cost.force + cost.tangent + cost.factor.value_or(0) + cost.solve.value_or(0);
  cost.step = {kFewestCorrections * each, kMaxCorrections * each};
  const double fewest = fewest_load_steps(statics);
  cost.steps = {fewest, std::min(kMaxCuts * fewest, static_cast<double>(statics.max_steps))};
}

// Buckling takes tangents for the stiffness and the stress stiffness, three factorisations, and Lanczos solutions.
void add_buckling(RunCost& cost) {
  constexpr double kTangents = 6, kFactors = 3, kFewestSolutions = 50, kMaxSolutions = 500;
  const double fixed = kTangents * cost.tangent + kFactors * cost.factor.value_or(0);
  cost.step = {fixed + kFewestSolutions * cost.solve.value_or(0), fixed + kMaxSolutions * cost.solve.value_or(0)};
  cost.steps = {1, 1};
}

// A harmonic analysis takes the tangent, two factorisations, Lanczos solutions, and two solutions at ten frequencies.
void add_harmonic(RunCost& cost) {
  constexpr double kTangents = 3, kFactors = 2, kFewestSolutions = 60, kMaxSolutions = 1000;
  const double fixed = kTangents * cost.tangent + kFactors * cost.factor.value_or(0);
  cost.step = {fixed + kFewestSolutions * cost.solve.value_or(0), fixed + kMaxSolutions * cost.solve.value_or(0)};
  cost.steps = {1, 1};
}

// Time (s) of `evaluate` on a new view of the state, as at an output time. The second call is measured, when data
// shared by all views exist.
template <class Evaluate>
double seconds_of(const Setup& setup, const Evaluate& evaluate) {
  double seconds = 0;
  for (int k = 0; k < 2; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    evaluate(ObservedState(*setup.built.model, setup.built.initial));
    seconds = seconds_since(begin);
  }
  return seconds;
}

// Time (s) to evaluate the powers of loads and damping at the two Gauss points of a step.
double seconds_of_powers(const Setup& setup) {
  const Traits& traits = setup.built.model->traits();
  return 2 * seconds_of(setup, [&](const ObservedState& at) {
           if (traits.dissipative) at.evaluate("power.dissipated");
           if (traits.loaded) at.evaluate("power.loads");
         });
}

double seconds_of_row(const Setup& setup) {
  const FemModel& model = *setup.built.model;
  const Output& output = setup.scene.output;
  ExtremeRecorder extremes(setup.scene, model);
  const auto columns = probe_columns(setup.scene, model);
  const double state = seconds_of(setup, [&](const ObservedState& at) {
    for (const auto& column : columns) at.evaluate(column.field);
    extremes.on_history(at);
    if (!setup.integrator) return;
    if (output.momentum) MomentumMeter().on_start(at);
    if (output.energy) EnergyMeter(model, *setup.integrator).on_start(at);
  });
  return setup.integrator && output.energy ? state + seconds_of_powers(setup) : state;
}

double seconds_of_frame(const Setup& setup) {
  return seconds_of(setup, [&](const ObservedState& at) {
    for (const auto& field : setup.scene.output.fields) at.evaluate(field);
  });
}

void add_outputs(const Setup& setup, RunCost& cost) {
  const OutputSize size = output_size_of(setup);
  cost.row = seconds_of_row(setup);
  cost.frame = seconds_of_frame(setup);
  cost.frames = size.frames;
  cost.rows = size.rows > 0 ? CostRange{size.rows, size.rows} : cost.steps;
}

// True for `modal`, and for `auto` with that choice.
bool uses_modes(const Integrator& integrator, const Config& config) {
  std::string method = config.at("integrator").at("type").text();
  for (const auto& [key, value] : integrator.decisions())
    if (key == "method") method = value;  // chosen by `auto`
  return method == "modal";
}

void add_time_steps(const Setup& setup, bool is_implicit, RunCost& cost) {
  const FemModel& model = *setup.built.model;
  cost.may_end_early = may_end_early(setup.scene);
  if (uses_modes(*setup.integrator, setup.config)) {
    constexpr double kForces = 8;  // force evaluations and solutions per step
    cost.step = {cost.force, kForces * (cost.force + cost.solve.value_or(0))};
    cost.steps = steps_of_modes(model);
    return;
  }
  cost.step = {cost.force, 2 * cost.force};  // including outputs and sums
  if (is_implicit) {
    const double each = kIterations * (cost.force + cost.solve.value_or(0));
    const double anew = cost.tangent + cost.factor.value_or(0);
    const double fewest = model.traits().linear ? 0 : kFewestTangents;
    cost.step = {each + fewest * anew, each + kMaxTangents * anew};
  }
  cost.has_contact = is_implicit && has_contact(model);
  cost.may_creep = is_implicit && may_creep(model);
  cost.steps = steps_of(setup, is_implicit, cost);
}

}  // namespace

RunCost run_cost(const Setup& setup, const std::vector<TermCost>& costs) {
  RunCost cost;
  for (const TermCost& term : costs) cost.force += term.force, cost.tangent += term.tangent;
  const bool is_implicit = !setup.integrator || setup.integrator->factor_bytes() > 0;
  if (is_implicit) measure_factor(setup, cost);
  if (setup.scene.buckling || setup.scene.harmonic) {
    setup.scene.buckling ? add_buckling(cost) : add_harmonic(cost);
    return cost;
  }
  setup.integrator ? add_time_steps(setup, is_implicit, cost) : add_load_steps(*setup.scene.statics, cost);
  add_outputs(setup, cost);
  return cost;
}

std::string shown_seconds(const CostRange& range) {
  const auto unit_of = [](double seconds) -> std::pair<double, const char*> {
    if (seconds >= 2 * 86400) return {86400, "days"};
    if (seconds >= 2 * 3600) return {3600, "h"};
    if (seconds >= 120) return {60, "min"};
    return {1, "s"};
  };
  constexpr double kOneUnit = 100;  // ratio up to which both limits share a unit
  const auto [size, unit] = unit_of(range.most);
  if (range.most <= kOneUnit * range.least)
    return fmt::format("{:.3g} to {:.3g} {}", range.least / size, range.most / size, unit);
  const auto [small, small_unit] = unit_of(range.least);
  return fmt::format("{:.3g} {} to {:.3g} {}", range.least / small, small_unit, range.most / size, unit);
}

}  // namespace orthodyn
