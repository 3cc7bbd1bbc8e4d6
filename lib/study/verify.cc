#include "lib/study/verify.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lib/run/run.h"
#include "lib/run/statics.h"
#include "lib/scene/equilibrium.h"
#include "lib/scene/setup.h"
#include "lib/study/figure.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

CaseResult verify_equilibrium(const std::string& file, const Setup& setup, const std::vector<Quantity>& quantities) {
  const StaticProblem problem = static_problem(setup.scene, setup.built);
  const Outcome outcome = run_static(*problem.stepper, {}, {false});
  CaseResult result{file, outcome.message, outcome.wall_seconds, {}};
  const State state{problem.path->time(), outcome.last.q, outcome.last.v};
  for (std::size_t q = 0; q < quantities.size(); ++q)
    result.checks.push_back(
        {setup.scene.expect[q], problem.stepper->done() ? quantities[q].values(state)[0] : std::nan("")});
  return result;
}

}  // namespace

bool Check::passed() const { return std::abs(difference()) <= expectation.limit(); }

bool CaseResult::passed() const {
  return failure.empty() && std::all_of(checks.begin(), checks.end(), [](const Check& c) { return c.passed(); });
}

std::vector<std::string> find_cases(const std::vector<std::string>& places) {
  std::vector<std::string> files;
  for (const auto& place : places) {
    if (!fs::exists(place)) throw ConfigError(place + ": no such file or folder");
    if (!fs::is_directory(place)) {
      files.push_back(place);
      continue;
    }
    std::vector<std::string> here;
    for (const auto& entry : fs::directory_iterator(place))
      if (entry.path().extension() == ".yaml") here.push_back(entry.path().string());
    if (here.empty()) throw ConfigError(place + ": holds no *.yaml files");
    std::sort(here.begin(), here.end());
    files.insert(files.end(), here.begin(), here.end());
  }
  return files;
}

CaseResult verify(const Config& scene) {
  Setup setup = set_up(scene);
  const auto& expectations = setup.scene.expect;
  if (expectations.empty()) scene.fail("expects nothing; add a list 'expect' (see `orthodyn list expect`)");
  const Origin origin{scene.where()};
  std::vector<Quantity> quantities;
  for (const auto& e : expectations)
    quantities.push_back(find_quantity(e.quantity, setup.scene, *setup.built.model, origin));

  if (setup.scene.analysis == Analysis::statical) return verify_equilibrium(scene.file(), setup, quantities);

  SeriesRecorder recorder(*setup.built.model, *setup.integrator, std::move(quantities));
  Plan plan{setup.scene.time.end, times_asked_for(expectations, setup.scene.time.start), false};
  EventFinder events(setup.events);
  if (!events.empty()) plan.events = &events;
  const std::atomic<bool> never{false};
  const Outcome outcome = run(*setup.built.model, *setup.integrator, setup.built.initial, plan, {&recorder}, never);
  CaseResult result{scene.file(), outcome.message, outcome.wall_seconds, {}};
  const bool ended = outcome.status == Outcome::Status::completed;
  for (std::size_t q = 0; q < expectations.size(); ++q)
    result.checks.push_back({expectations[q], ended ? figure(expectations[q], recorder, q) : std::nan("")});
  return result;
}

}  // namespace orthodyn
