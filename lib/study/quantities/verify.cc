#include "lib/study/quantities/verify.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "lib/analysis/buckling.h"
#include "lib/core/file_kind.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"
#include "lib/simulation/statics/load_steps.h"
#include "lib/simulation/statics/static_problem.h"
#include "lib/study/quantities/response_metric.h"
#include "lib/study/quantities/series.h"
#include "lib/study/quantities/wanted_modes.h"

namespace orthodyn::study {

namespace fs = std::filesystem;

namespace {

// The expectations of quantities, and their quantities in the same order.
struct ExpectedQuantities {
  std::vector<Expectation> expectations;
  std::vector<Quantity> quantities;
};

ExpectedQuantities expected_quantities(const Setup& setup) {
  const SourceLocation origin{setup.config.where()};
  ExpectedQuantities wanted;
  for (const auto& e : setup.scene.expect) {
    if (e.is_eigenvalue()) continue;
    wanted.expectations.push_back(e);
    wanted.quantities.push_back(find_quantity(e.quantity, setup.scene, *setup.built.model, origin));
  }
  return wanted;
}

CaseResult verify_equilibrium(const Setup& setup, const std::atomic<bool>& interrupt) {
  const auto [expectations, quantities] = expected_quantities(setup);
  const StaticProblem problem = static_problem(setup.scene, setup.built);
  CaseResult result{setup.config.file(), run_static(*problem.path, *problem.stepper, {}, interrupt), {}};
  if (setup.linearity) setup.linearity->require(problem.path->times().end, result.outcome.last.q);
  const State state{problem.path->times().end, result.outcome.last.q, result.outcome.last.v};
  const ObservedState observed(*setup.built.model, state);
  for (std::size_t q = 0; q < quantities.size(); ++q)
    result.checks.push_back({expectations[q],
                             problem.stepper->done() ? quantities[q].values(observed)[0] : std::nan(""),
                             quantities[q].unit});
  return result;
}

CaseResult verify_motion(const Setup& setup, std::vector<Observer*> observers, const std::atomic<bool>& interrupt) {
  const auto [expectations, quantities] = expected_quantities(setup);
  SeriesRecorder recorder(*setup.built.model, *setup.integrator, quantities);
  observers.push_back(&recorder);
  if (setup.linearity) observers.push_back(setup.linearity.get());
  Plan plan{setup.scene.time.end, requested_times(expectations, setup.scene.time.start), false};
  EventFinder events(setup.events);
  if (!events.empty()) plan.events = &events;
  CaseResult result{setup.config.file(),
                    run(*setup.built.model, *setup.integrator, setup.built.initial, plan, observers, interrupt),
                    {}};
  for (std::size_t q = 0; q < expectations.size(); ++q)
    result.checks.push_back({expectations[q], result.completed() ? metric(expectations[q], recorder, q) : std::nan(""),
                             metric_unit(expectations[q].take, quantities[q].unit)});
  return result;
}

CaseResult verify_response(const Setup& setup) {
  const auto columns = response_columns(setup.scene, *setup.built.model);
  CaseResult result{setup.config.file(), {}, {}};
  for (const auto& e : setup.scene.expect) {
    if (e.is_eigenvalue()) continue;
    const std::string& unit = columns[find_column(columns, e.quantity, e.origin)].unit;
    result.checks.push_back({e, std::nan(""), metric_unit(e.response_metric(), unit)});
  }
  result.outcome = supervise(setup.built.initial, {}, [&](Outcome&) {
    const HarmonicResponse response(setup);
    for (Check& check : result.checks) {
      const Expectation& e = check.expectation;
      check.computed = metric(response, find_column(columns, e.quantity, e.origin), e.response_metric(), e.frequency);
      if (e.response_metric() == ResponseMetric::phase)  // the angle nearest to the expected one
        check.computed = e.value + std::remainder(check.computed - e.value, 2 * std::numbers::pi);
    }
  });
  return result;
}

CaseResult verify_motion_or_equilibrium(const Setup& setup, const std::vector<Observer*>& observers,
                                        const std::atomic<bool>& interrupt) {
  const bool has_quantities = !std::ranges::all_of(setup.scene.expect, &Expectation::is_eigenvalue);
  if (!has_quantities) {
    CaseResult result{setup.config.file(), {}, {}};
    result.outcome.last = setup.built.initial;
    return result;
  }
  if (setup.scene.harmonic) return verify_response(setup);
  return setup.scene.is_static() ? verify_equilibrium(setup, interrupt) : verify_motion(setup, observers, interrupt);
}

void check_frequencies(const Setup& setup, std::vector<Check>& checks) {
  std::vector<WantedMetric> wanted;
  for (const auto& e : setup.scene.expect)
    if (e.mode) wanted.push_back({.mode = e.mode});
  if (wanted.empty()) return;
  const Scene scene = setup.scene.is_static() ? setup.scene : at_rest(setup.scene);
  const BuiltScene built = build(scene);
  const Vector zero = Vector::Zero(built.model->num_dofs());
  const WantedModes found = wanted_modes(wanted, *built.model, {scene.time.end, zero, zero, 0});
  auto chosen = found.chosen.begin();
  for (const auto& e : setup.scene.expect) {
    if (!e.mode) continue;
    checks.push_back({e, *chosen ? found.modes.modes[**chosen].frequency() : std::nan(""), "Hz"});
    ++chosen;
  }
}

void check_load_factors(const Setup& setup, std::vector<Check>& checks) {
  int count = 0;
  for (const auto& e : setup.scene.expect) count = std::max(count, e.buckling.value_or(0));
  if (count == 0) return;
  const double t = setup.scene.time.end;
  const FemModel& model = *setup.built.model;
  require_held(setup.scene, model, t);
  const auto modes = buckling_modes(model, unloaded_shape(setup.scene, setup.built), t, count).modes;
  for (const auto& e : setup.scene.expect) {
    if (!e.buckling) continue;
    const auto k = static_cast<std::size_t>(*e.buckling - 1);
    checks.push_back({e, k < modes.size() ? modes[k].load_factor : std::nan(""), ""});
  }
}

// Checks of the natural frequencies, then of the critical load factors; NaN for a mode that does not exist. Throws what
// natural_modes() and buckling_modes() throw.
std::vector<Check> eigenvalue_checks(const Setup& setup) {
  std::vector<Check> checks;
  check_frequencies(setup, checks);
  check_load_factors(setup, checks);
  return checks;
}

// Adds the checks and the time of the eigenvalue solution to the run's. If the eigenvalue solution fails, so does the
// run.
void verify_eigenvalues(const Setup& setup, CaseResult& result) {
  if (std::ranges::none_of(setup.scene.expect, &Expectation::is_eigenvalue)) return;
  std::vector<Check> checks;
  const Outcome outcome = supervise(result.outcome.last, {}, [&](Outcome&) { checks = eigenvalue_checks(setup); });
  result.outcome.wall_seconds += outcome.wall_seconds;
  result.outcome.cpu_seconds += outcome.cpu_seconds;
  if (result.completed()) result.outcome.status = outcome.status, result.outcome.message = outcome.message;
  result.checks.insert(result.checks.end(), checks.begin(), checks.end());
}

}  // namespace

bool Check::passed() const { return std::abs(difference()) <= expectation.limit(); }

bool CaseResult::passed() const {
  return completed() && std::all_of(checks.begin(), checks.end(), [](const Check& c) { return c.passed(); });
}

std::vector<std::string> find_cases(const std::vector<std::string>& places) {
  std::vector<std::string> files;
  for (const auto& place : places) {
    if (!is_there(place)) throw ConfigError(place, "no such file or folder");
    if (!is_folder(place)) {
      files.push_back(place);
      continue;
    }
    std::vector<std::string> here;
    for (const auto& entry : fs::directory_iterator(place))
      if (entry.path().extension() == ".yaml") here.push_back(entry.path().string());
    if (here.empty()) throw ConfigError(place, "contains no *.yaml files");
    std::sort(here.begin(), here.end());
    files.insert(files.end(), here.begin(), here.end());
  }
  return files;
}

void require_expectations(const Scene& scene, const Config& config) {
  if (scene.expect.empty())
    config.fail("has no 'expect' list, so there is nothing to verify (see `orthodyn list expect`)");
}

CaseResult verify(const Config& scene) {
  const std::atomic<bool> never{false};
  return verify(set_up(scene), {}, never);
}

CaseResult verify(const Setup& setup, const std::vector<Observer*>& observers, const std::atomic<bool>& interrupt) {
  require_expectations(setup.scene, setup.config);
  CaseResult result = verify_motion_or_equilibrium(setup, observers, interrupt);
  verify_eigenvalues(setup, result);
  return result;
}

}  // namespace orthodyn::study
