#include "lib/simulation/preflight/faster_setup.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "lib/analysis/linearity.h"
#include "lib/analysis/static_response.h"
#include "lib/core/errors.h"
#include "lib/simulation/error_estimate/mass_norm.h"
#include "lib/simulation/preflight/input_checks/input_checks.h"

namespace orthodyn {

namespace {

constexpr double kLeastSaving = 3;       // least ratio of run times; large, because these are rough
constexpr double kMaxError = 0.02;       // relative error by linear kinematics
constexpr double kSecondsOfCosts = 0.3;  // for measuring the terms

double about(const CostRange& range) { return std::sqrt(range.least * range.most); }

std::vector<std::string> changes_for(const Setup& setup) {
  std::vector<std::string> changes;
  if (!setup.built.model->traits().linear) changes.emplace_back("elasticity.kinematics: linear");
  if (setup.config.at("integrator").at("type").text() != "auto")
    changes.push_back(fmt::format("integrator: {{type: auto, rtol: {:g}}}", requested_accuracy(setup.scene)));
  return changes;
}

// Replaces the whole section `integrator`, because its keys belong to the present method.
Config changed(const Setup& setup) {
  Config config = setup.config.copy().resolving();
  if (!setup.built.model->traits().linear) config.set("elasticity.kinematics", std::string("linear"));
  config.override_with(fmt::format("integrator={{type: auto, rtol: {}}}", requested_accuracy(setup.scene)));
  return config;
}

std::string name_of_method(const Integrator& integrator) {
  std::string method, modes;
  for (const auto& [key, value] : integrator.decisions()) {
    if (key == "method") method = value;
    if (key == "modes") modes = ", " + value + " modes";
  }
  return method + modes;
}

std::optional<FasterSetup> with_changes(const Setup& setup, const RunCost& cost) {
  FasterSetup way{.changes = changes_for(setup), .method = {}, .now = about(cost.seconds())};
  if (way.changes.empty()) return std::nullopt;
  const Setup other = set_up(changed(setup));
  if (!other.built.model->traits().linear) return std::nullopt;
  way.method = name_of_method(*other.integrator);
  if (!setup.built.model->traits().linear) way.error = error_of_linear_kinematics(other);
  other.integrator->start(other.built.initial);
  const RunCost then = run_cost(other, term_costs(*other.built.model, other.built.initial, kSecondsOfCosts));
  way.then = other.wall_seconds + about(then.seconds());
  return way;
}

}  // namespace

std::optional<FasterSetup> faster_setup(const Setup& setup, const RunCost& cost) try {
  if (!setup.integrator || setup.kinematics || setup.scene.elasticity.is_warped() ||
      setup.built.model->num_dofs() > kMaxUnknownsOfResponse)
    return std::nullopt;
  return with_changes(setup, cost);
} catch (const ConfigError&) {  // the changed scene is only a proposal; it may be invalid
  return std::nullopt;
} catch (const RunError&) {
  return std::nullopt;
} catch (const RecoverableError&) {
  return std::nullopt;
}

bool FasterSetup::pays() const { return now >= kLeastSaving * then && error.value_or(0) <= kMaxError; }

double error_of_linear_kinematics(const Setup& linear) {
  const FemModel& model = *linear.built.model;
  const auto& [start, end] = linear.scene.time;
  const State& initial = linear.built.initial;
  const StaticResponse statics = static_response(model, initial, end);
  if (model.parts().moved || !initial.q.isZero(0) || !initial.v.isZero(0) || !statics.exists() || !(statics.work > 0))
    return std::numeric_limits<double>::infinity();
  Linearity::Terms terms(model.parts().elastic.size());
  std::iota(terms.begin(), terms.end(), 0u);
  Linearity linearity(model, terms, end - start);
  const Vector half = load_duration_factor(model.space(), statics) * statics.displacement, all = 2 * half;
  const double omega = std::sqrt(statics.work / mass_product(model, statics.displacement));
  const VibrationDrift drift = linearity.drift(end, half, half, omega);
  return linearity.error(end, all).displacement + drift.after(end - start) / std::sqrt(mass_product(model, all));
}

}  // namespace orthodyn
