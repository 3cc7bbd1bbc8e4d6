#include "lib/simulation/faster.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "lib/analysis/linearity.h"
#include "lib/analysis/static_response.h"
#include "lib/core/errors.h"
#include "lib/simulation/slips/slips.h"

namespace orthodyn {

namespace {

constexpr double kLeastSaving = 2;       // times
constexpr double kMostError = 0.02;      // of the motion, by linear kinematics
constexpr double kSecondsOfCosts = 0.3;  // in which terms are measured

double about(const CostRange& range) { return std::sqrt(range.least * range.most); }

// Of the motion at the end: at the largest displacement that loads reach, and what adds up in vibrations about half of
// it. Infinite where no response is known.
double error_of_linear(const Setup& linear) {
  const FemModel& model = *linear.built.model;
  const auto& [start, end] = linear.scene.time;
  const StaticResponse statics = static_response(model, linear.built.initial, end);
  if (!statics.exists() || !(statics.work > 0)) return std::numeric_limits<double>::infinity();
  Linearity::Terms terms(model.parts().elastic.size());
  std::iota(terms.begin(), terms.end(), 0u);
  Linearity linearity(model, terms, end - start);
  const Vector half = share_reached(model.space(), statics) * statics.displacement, all = 2 * half;
  Vector momentum(all.size());
  model.multiply_mass(statics.displacement, momentum);
  const double omega = std::sqrt(statics.work / statics.displacement.dot(momentum));
  model.multiply_mass(all, momentum);
  const VibrationDrift drift = linearity.drift(end, half, half, omega);
  const double decay = drift.decay * (end - start);
  const double phase = drift.rate * (end - start) * (decay > 0 ? -std::expm1(-decay) / decay : 1);
  return linearity.error(end, all).displacement + phase / std::sqrt(all.dot(momentum));
}

// With the changes that a faster way needs; empty where the scene has them already.
std::vector<std::pair<std::string, std::string>> changes_for(const Setup& setup) {
  std::vector<std::pair<std::string, std::string>> changes;
  if (!setup.built.model->traits().linear) changes.emplace_back("elasticity.kinematics", "linear");
  if (setup.config.at("integrator").at("type").text() != "auto") changes.emplace_back("integrator.type", "auto");
  return changes;
}

Config changed(const Setup& setup, const std::vector<std::pair<std::string, std::string>>& changes) {
  Config config = setup.config.copy().resolving();
  for (const auto& [key, value] : changes)
    if (key != "integrator.type") config.set(key, value);
  // Without what the program has decided for the method that the scene names.
  const double rtol = accuracy_asked_for(setup.scene);
  config.override_with(fmt::format("integrator={{type: auto, rtol: {}}}", rtol));
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

std::optional<FasterWay> with_changes(const Setup& setup, const RunCost& cost) {
  const auto changes = changes_for(setup);
  if (changes.empty()) return std::nullopt;
  const Setup other = set_up(changed(setup, changes));
  if (!other.built.model->traits().linear) return std::nullopt;
  FasterWay way{.method = name_of_method(*other.integrator), .now = about(cost.seconds())};
  for (const auto& [key, value] : changes) way.changes.push_back(key + ": " + value);
  const RunCost then = run_cost(other, term_costs(*other.built.model, other.built.initial, kSecondsOfCosts));
  const bool is_modal = way.method.starts_with("modal");  // its modes are found while it is made, and few steps follow
  way.then = other.wall_seconds + about(is_modal ? then.outputs() : then.seconds());
  if (way.now < kLeastSaving * way.then) return std::nullopt;
  if (!setup.built.model->traits().linear) {
    way.error = error_of_linear(other);
    if (!(*way.error <= kMostError)) return std::nullopt;
  }
  return way;
}

}  // namespace

std::optional<FasterWay> faster_way(const Setup& setup, const RunCost& cost) try {
  if (!setup.integrator || setup.kinematics || setup.scene.elasticity.is_warped() ||
      setup.built.model->num_dofs() > kLargestForSlips)
    return std::nullopt;
  return with_changes(setup, cost);
} catch (const ConfigError&) {  // the scene as it is has its own sentences
  return std::nullopt;
} catch (const RunError&) {
  return std::nullopt;
} catch (const RecoverableError&) {
  return std::nullopt;
}

}  // namespace orthodyn
