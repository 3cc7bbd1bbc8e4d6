#include "lib/simulation/run/kinematics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/analysis/static_response.h"
#include "lib/core/spelling.h"

namespace orthodyn {

namespace {

constexpr double kOfRtol = 10;                             // allowed: what errors of steps add up to, roughly
constexpr double kUsual = 1e-3;                            // allowed where there is no rtol
constexpr double kShareOfAllowed = 0.5;                    // up to which the error may grow before it is computed again
constexpr double kLeastGrowth = 1.05, kLargestGrowth = 2;  // of the displacement in between
constexpr double kTiny = 1e-300;                           // in place of zero
constexpr int kLargestToldOf = 200000;                     // unknowns: a factorisation of more is not done unasked
constexpr double kOvershoot = 2;                           // of a load applied at once, over its static response
constexpr double kParted = 2;                              // relative error of two motions that are fully out of phase
constexpr double kHopeless = 1;                            // relative error above which no better estimate is needed
constexpr double kClearly = 3;  // times what is allowed: then linear kinematics are not tried

double allowed_error(const Scene& scene) {
  if (scene.elasticity.linear_error) return *scene.elasticity.linear_error;
  if (scene.integrator)
    if (const auto rtol = scene.integrator->settings().rtol) return kOfRtol * *rtol;
  return kUsual;
}

constexpr const char* kUnstable = "the body buckles below these loads, which linear kinematics do not show";

std::string how_much(double error, const char* format = "{:.3g}") {
  return std::isfinite(error) ? "about " + fmt::format(fmt::runtime(format), error) + " of the motion"
                              : std::string("an amount that could not be estimated");
}

bool is_open(const Scene& scene, const Region& region) {
  return elasticity_of(scene, region).kinematics == Kinematics::automatic;
}

std::vector<std::string> open_regions(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& [name, region] : scene.regions)
    if (is_open(scene, region)) names.push_back(name);
  return names;
}

double end_of_motion(const Scene& scene) {
  return scene.is_static() ? std::numeric_limits<double>::infinity() : scene.time.end;
}

Scene with_linear_regions(Scene scene) {
  for (auto& [name, region] : scene.regions)
    if (is_open(scene, region)) region.kinematics = Kinematics::linear;
  return scene;
}

// Of the scene's entries `names`, those that describe elements.
std::vector<LinearRegion> linear_regions(const Scene& scene, const std::vector<std::string>& names,
                                         const FemModel& model) {
  std::vector<LinearRegion> regions;
  for (const auto& name : names) {
    Linearity::Terms terms;
    for (std::size_t k = 0; k < model.parts().elastic.size(); ++k)
      if (entry_of(scene, model.parts().elastic[k]->region()).first == name) terms.push_back(k);
    if (!terms.empty()) regions.push_back({name, std::move(terms)});
  }
  return regions;
}

Linearity::Terms terms_of(const std::vector<LinearRegion>& regions) {
  Linearity::Terms all;
  for (const auto& region : regions) all.insert(all.end(), region.terms.begin(), region.terms.end());
  return all;
}

std::vector<std::string> names_of(const std::vector<LinearRegion>& regions) {
  std::vector<std::string> names;
  for (const auto& region : regions) names.push_back(region.name);
  return names;
}

bool says_auto(const Config& section) {
  return section.has("kinematics") && !section.at("kinematics").is_null() && section.at("kinematics").text() == "auto";
}

// Where a scene leaves kinematics open: for all, or for a region.
Config place_of_auto(const Config& scene) {
  const Config elasticity = scene.at("elasticity");
  return says_auto(elasticity) ? elasticity.at("kinematics") : scene.at("regions");
}

// "" where the integrator serves corotational kinematics, too.
std::string only_linear_integrator(const Config& config, const Scene& scene) {
  const bool is_only =
      scene.analysis == Analysis::dynamic && scene.integrator && scene.integrator->needs_linear_model();
  return is_only ? config.at("integrator").at("type").text() : "";
}

std::string other_integrator(const std::string& only_linear) {
  return only_linear + " is for linear kinematics only: use another integrator, such as cvode_bdf";
}

}  // namespace

bool leaves_kinematics_open(const Scene& scene) { return !open_regions(scene).empty(); }

void make_corotational(Config& config) {
  const std::string corotational = "corotational";
  if (config.has("elasticity")) {
    Config elasticity = config.at("elasticity");
    if (says_auto(elasticity)) elasticity.set("kinematics", corotational);
    if (elasticity.has("linear_error")) elasticity.set("linear_error", nullptr);
  }
  if (!config.has("regions")) return;
  for (const auto& name : config.at("regions").keys())
    if (Config region = config.at("regions").at(name); says_auto(region)) region.set("kinematics", corotational);
}

LinearityWatch::LinearityWatch(const FemModel& model, std::vector<LinearRegion> regions, double start, double end,
                               double allowed, std::string only_linear)
    : model_(model),
      regions_(std::move(regions)),
      allowed_(allowed),
      start_(start),
      span_(end - start),
      time_(start),
      largest_{start, 0, Vector::Zero(model.num_dofs())},
      only_linear_(std::move(only_linear)) {
  if (std::isfinite(span_)) phase_.emplace(model, start);
}

Linearity& LinearityWatch::linearity() {
  if (!linearity_) linearity_.emplace(model_, terms_of(regions_), span_);
  return *linearity_;
}

double LinearityWatch::norm(const Vector& x) const {
  Vector Mx(x.size());
  model_.multiply_mass(x, Mx);
  return std::sqrt(std::max(x.dot(Mx), 0.0));
}

void LinearityWatch::note(double t, const Vector& q) {
  checked_ = norm(q);
  const LinearityError found = linearity().error(t, q);
  local_ = std::max(local_, found.displacement);
  stiffness_ = std::max(stiffness_, found.stiffness);
  unstable_ = unstable_ || found.unstable;
  error_ = std::max(error_, local_);
}

void LinearityWatch::finish_at(double t, const Vector& q) {
  time_ = t;
  largest_ = {t, norm(q), q};
  finish();
}

void LinearityWatch::require(double t, const Vector& q) {
  if (!std::isfinite(allowed_)) return;
  finish_at(t, q);
  if (outgrown()) refuse_outgrown();
}

void LinearityWatch::refuse_outgrown() const {
  throw RunError(outgrown_sentence(*this) + "; " +
                 (only_linear_.empty() ? "set elasticity.kinematics: corotational"
                                       : other_integrator(only_linear_) + ", or raise elasticity.linear_error"));
}

std::optional<Outgrown> LinearityWatch::why_to_start_again() {
  if (!outgrown() || !only_linear_.empty()) return std::nullopt;
  return Outgrown{to_give_up(largest_.t, largest_.q), outgrown_sentence(*this)};
}

void LinearityWatch::finish() {
  try {
    if (largest_.norm > checked_) note(largest_.t, largest_.q);
    const bool is_known = error_ < kHopeless;
    error_ = std::max(error_, local_ + share(phase_ && is_known ? phase_->error_now(linearity()) : 0));
  } catch (const RunError&) {
    error_ = std::numeric_limits<double>::quiet_NaN();
  }
}

void LinearityWatch::save(Archive& archive) {
  archive.put("found", {checked_, local_, stiffness_, error_, largest_.t});
  archive.put("largest", std::vector<double>(largest_.q.begin(), largest_.q.end()));
  if (phase_) phase_->save(archive);
}

void LinearityWatch::restore(const Archive& archive) {
  const auto& found = archive.numbers("found", 5);
  checked_ = found[0], local_ = found[1], stiffness_ = found[2], error_ = found[3];
  const auto& q = archive.numbers("largest", static_cast<std::size_t>(model_.num_dofs()));
  largest_.t = found[4];
  largest_.q = Eigen::Map<const Vector>(q.data(), model_.num_dofs());
  largest_.norm = norm(largest_.q);
  if (phase_) phase_->restore(archive);
}

// The error grows no faster than the square of the displacement.
double LinearityWatch::next_look() const {
  if (!std::isfinite(allowed_)) return allowed_;
  const double growth = std::sqrt(kShareOfAllowed * allowed_ / std::max(local_, kTiny));
  return std::clamp(growth, kLeastGrowth, kLargestGrowth) * checked_;
}

void LinearityWatch::look_at(const State& state) {
  time_ = state.t;
  if (const double q = norm(state.q); q > largest_.norm) largest_ = {state.t, q, state.q};
  if (largest_.norm > next_look()) note(state.t, state.q);
  if (phase_) phase_->look_at(state);
  if (phase_ && phase_->is_full()) take_in_phase();
  if (outgrown()) refuse_outgrown();
}

void LinearityWatch::take_in_phase() {
  if (!(error_ < kHopeless)) return phase_->skip();
  try {
    phase_->take_in(linearity());
    error_ = std::max(error_, local_ + share(phase_->error()));
  } catch (const RunError&) {
    error_ = std::numeric_limits<double>::quiet_NaN();
  }
}

// Motions that have parted differ by twice their size at most.
double LinearityWatch::share(double phase) const {
  return largest_.norm > 0 ? std::min(phase / largest_.norm, kParted) : 0;
}

double LinearityWatch::phase_of(double stiffness) const {
  if (!phase_ || !(stiffness_ > 0)) return 0;
  return share(phase_->error()) * std::min(stiffness / stiffness_, 1.0);
}

std::vector<std::string> LinearityWatch::to_give_up(double t, const Vector& q) {
  std::vector<std::pair<double, std::string>> errors;
  for (const auto& [name, terms] : regions_) {
    const LinearityError found = linearity().error(t, q, terms);
    errors.emplace_back(found.displacement + phase_of(found.stiffness), name);
  }
  std::sort(errors.begin(), errors.end());
  std::vector<std::string> names{errors.back().second};
  errors.pop_back();
  double sum = 0;
  for (const auto& [error, name] : errors)
    if ((sum += error) > allowed_ / 2) names.push_back(name);
  return names;
}

std::string outgrown_sentence(const LinearityWatch& watch) {
  if (watch.unstable()) return kUnstable;
  return fmt::format("linear kinematics are off by {} at t = {:.6g} s, where {:.3g} is allowed",
                     how_much(watch.error()), watch.time(), watch.allowed());
}

std::string outcome_of(const LinearityWatch& watch) {
  const bool is_whole = terms_of(watch.regions()).size() == watch.num_regions();
  const std::string where = is_whole ? "" : " in " + join(names_of(watch.regions()));
  if (std::isnan(watch.error())) return fmt::format("linear{}: how far off is not known", where);
  if (watch.unstable()) return fmt::format("linear{}: {}", where, kUnstable);
  const bool is_watched = std::isfinite(watch.allowed());
  return fmt::format("linear{}: off by {}{}", where, how_much(watch.error(), "{:.1e}"),
                     is_watched ? fmt::format(", where {:.1e} is allowed", watch.allowed()) : "");
}

namespace {

// The same of some of those that are left open, and says so: "corotational in arm: why".
std::string make_corotational(Config& config, const std::vector<std::string>& regions, const std::string& why) {
  const auto is_written = [&](const std::string& name) {
    return config.has("regions") && config.at("regions").has(name);
  };
  if (regions.size() == open_regions(read_scene(config)).size() ||
      !std::all_of(regions.begin(), regions.end(), is_written)) {
    make_corotational(config);
    return "corotational: " + why;
  }
  for (const auto& name : regions) {
    Config region = config.at("regions").at(name);
    region.set("kinematics", std::string("corotational"));
  }
  return fmt::format("corotational in {}: {}", join(regions), why);
}

}  // namespace

void start_again_if_outgrown(const Config& scene, const KinematicsAttempt& attempt) {
  Config now = scene.copy();
  KinematicsChoice choice;
  while (const auto outgrown = attempt(now.copy(), choice.reason))
    choice.add_reason(make_corotational(now, outgrown->regions, outgrown->why));
}

namespace {

// Accepts linear kinematics where they are open, or says which regions they are not for, and why.
struct Trial {
  std::vector<std::string> given_up = {};
  std::string why = {};
  std::unique_ptr<LinearityWatch> watch = {};
};

Trial try_linear(const Scene& scene, const std::vector<std::string>& open, const BuiltScene& built, double allowed,
                 bool predict, const std::string& only_linear) {
  const bool is_static = scene.is_static();
  try {
    auto watch = std::make_unique<LinearityWatch>(*built.model, linear_regions(scene, open, *built.model),
                                                  scene.time.start, end_of_motion(scene), allowed, only_linear);
    watch->error_at(scene.time.start, Vector::Zero(built.model->num_dofs()));  // throws where it cannot be computed
    if (!predict) return {.watch = std::move(watch)};
    const StaticResponse response = static_response(*built.model, built.initial, scene.time.end);
    if (!response.exists()) return {.watch = std::move(watch)};
    const double reached = is_static ? 1 : kOvershoot * share_reached(built.model->space(), response);
    const Vector q = built.initial.q + reached * response.displacement;
    const LinearityError error = watch->error_at(scene.time.end, q);
    if (error.displacement <= kClearly * allowed) return {.watch = std::move(watch)};
    return {.given_up = watch->to_give_up(scene.time.end, q),
            .why = error.unstable ? kUnstable
                                  : fmt::format("linear kinematics would be off by {}{}, where {:.2g} is allowed",
                                                how_much(error.displacement),
                                                is_static ? "" : " at the displacement that the loads reach", allowed)};
  } catch (const RunError& e) {
    return {.given_up = open, .why = e.what()};
  }
}

}  // namespace

bool is_linear_anywhere(const Scene& scene) {
  return std::any_of(scene.regions.begin(), scene.regions.end(), [&](const auto& entry) {
    return elasticity_of(scene, entry.second).kinematics == Kinematics::linear;
  });
}

std::unique_ptr<LinearityWatch> watch_for_the_end(const Scene& scene, const FemModel& model) {
  if (model.num_dofs() > kLargestToldOf) return nullptr;
  std::vector<std::string> names;
  for (const auto& [name, region] : scene.regions)
    if (elasticity_of(scene, region).kinematics == Kinematics::linear) names.push_back(name);
  auto regions = linear_regions(scene, names, model);
  if (regions.empty()) return nullptr;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  return std::make_unique<LinearityWatch>(model, std::move(regions), scene.time.start, end_of_motion(scene), kAny);
}

ChosenKinematics choose_kinematics(Config& config, Scene& scene, bool linear_so_far) {
  const double allowed = allowed_error(scene);
  const std::string only_linear = only_linear_integrator(config, scene);
  KinematicsChoice choice;
  if (scene.analysis == Analysis::buckling) {  // linear ones have no stress stiffness
    make_corotational(config);
    scene = read_scene(config);
    return {std::move(choice), build(scene), nullptr};
  }
  for (auto open = open_regions(scene); !open.empty(); open = open_regions(scene)) {
    const Scene linear = with_linear_regions(scene);
    BuiltScene built = build(linear);
    if (linear_regions(linear, open, *built.model).empty()) break;  // entries that describe no element
    Trial trial = try_linear(linear, open, built, allowed, !linear_so_far, only_linear);
    if (trial.watch) {
      config.set("elasticity.linear_error", allowed);
      scene = linear;
      choice.linear = choice.reason.empty();
      return {std::move(choice), std::move(built), std::move(trial.watch)};
    }
    if (!only_linear.empty())
      place_of_auto(config).fail(trial.why + ", and " + other_integrator(only_linear) +
                                 ", or raise elasticity.linear_error");
    choice.add_reason(make_corotational(config, trial.given_up, trial.why));
    scene = read_scene(config);
  }
  return {std::move(choice), build(scene), nullptr};
}

}  // namespace orthodyn
