#include "lib/simulation/kinematics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/analysis/static_response.h"

namespace orthodyn {

namespace {

constexpr double kOfRtol = 10;        // what errors of steps add up to, roughly
constexpr double kUsual = 1e-3;       // allowed where there is no rtol
constexpr double kMoreBy = 1.05;      // a displacement larger by this is looked at
constexpr double kOvershoot = 2;      // of a load applied at once, over its static response
constexpr double kClearly = 3;        // times what is allowed: then linear kinematics are not tried

double allowed_error(const Scene& scene) {
  if (scene.elasticity.linear_error) return *scene.elasticity.linear_error;
  if (scene.integrator)
    if (const auto rtol = scene.integrator->settings().rtol) return kOfRtol * *rtol;
  return kUsual;
}

std::string how_much(double error) {
  return std::isfinite(error) ? fmt::format("about {:.3g}", error) : std::string("a good part");
}

// "" where the integrator serves corotational kinematics, too.
std::string only_linear_integrator(const Config& config, const Scene& scene) {
  const bool is_only =
      scene.analysis == Analysis::dynamic && scene.integrator && scene.integrator->needs_linear_model();
  return is_only ? config.at("integrator").at("type").text() : "";
}

std::string other_integrator(const std::string& only_linear) {
  return only_linear + " is for linear kinematics only: take another integrator, such as cvode_bdf";
}

Scene with(Config& config, const char* kinematics) {
  set_kinematics(config, kinematics);
  return read_scene(config);
}

}  // namespace

void set_kinematics(Config& config, const std::string& kinematics) {
  config.set("elasticity.kinematics", kinematics);
  if (config.at("elasticity").has("linear_error")) config.set("elasticity.linear_error", nullptr);
}

LinearityWatch::LinearityWatch(const FemModel& linear, std::unique_ptr<FemModel> exact, double start, double end,
                               double allowed, std::string only_linear)
    : linear_(linear), exact_(std::move(exact)), linearity_(linear_, *exact_, end - start), allowed_(allowed),
      start_(start), only_linear_(std::move(only_linear)) {}

double LinearityWatch::norm(const Vector& x) const {
  Vector Mx(x.size());
  linear_.multiply_mass(x, Mx);
  return std::sqrt(std::max(x.dot(Mx), 0.0));
}

void LinearityWatch::note(double t, const Vector& q) {
  time_ = t;
  const LinearityError found = linearity_.error(t, q);
  local_ = std::max(local_, found.displacement);
  stiffness_ = std::max(stiffness_, found.stiffness);
  error_ = std::max(error_, local_);
}

void LinearityWatch::require(double t, const Vector& q) {
  note(t, q);
  if (outgrown()) refuse_outgrown();
}

void LinearityWatch::refuse_outgrown() const {
  throw RunError(outgrown_sentence(*this) + "; " +
                 (only_linear_.empty() ? "set elasticity.kinematics: corotational"
                                       : other_integrator(only_linear_) + ", or raise elasticity.linear_error"));
}

std::string LinearityWatch::why_to_start_again() const {
  return outgrown() && only_linear_.empty() ? outgrown_sentence(*this) : "";
}

void LinearityWatch::save(Archive& archive) {
  archive.put("largest", {checked_, displacement_, velocity_, local_, stiffness_, error_});
}

void LinearityWatch::restore(const Archive& archive) {
  const auto& largest = archive.numbers("largest", 6);
  checked_ = largest[0], displacement_ = largest[1], velocity_ = largest[2];
  local_ = largest[3], stiffness_ = largest[4], error_ = largest[5];
}

// A stiffness that is off by a share of e shifts a frequency by e/2.
void LinearityWatch::look_at(const State& state) {
  time_ = state.t;
  const double q = norm(state.q);
  displacement_ = std::max(displacement_, q);
  velocity_ = std::max(velocity_, norm(state.v));
  if (q > kMoreBy * checked_) {
    note(state.t, state.q);
    checked_ = q;
  }
  const double turns = displacement_ > 0 ? velocity_ / displacement_ * (state.t - start_) : 0;  // rad
  error_ = std::max(error_, local_ + stiffness_ * turns / 2);
  if (outgrown()) refuse_outgrown();
}

void start_again_if_outgrown(const Config& scene, const KinematicsAttempt& attempt) {
  const std::string outgrown = attempt(scene.copy(), "");
  if (outgrown.empty()) return;
  Config corotational = scene.copy();
  set_kinematics(corotational, "corotational");
  attempt(std::move(corotational), outgrown);
}

std::string outgrown_sentence(const LinearityWatch& watch) {
  return fmt::format("linear kinematics are off by {} of the motion at t = {:.6g} s, where {:.3g} is allowed",
                     how_much(watch.error()), watch.time(), watch.allowed());
}

std::string outcome_of(const LinearityWatch& watch) {
  const double error = watch.error();
  return fmt::format("linear: off by {} of the motion at most, where {:.1e} is allowed",
                     std::isfinite(error) ? fmt::format("about {:.1e}", error) : how_much(error), watch.allowed());
}

ChosenKinematics choose_kinematics(Config& config, Scene& scene, bool linear_so_far) {
  const std::string only_linear = only_linear_integrator(config, scene);
  const std::string place = config.at("elasticity").at("kinematics").where();
  const auto corotational = [&](const std::string& reason, const std::string& remedy = "") {
    if (!only_linear.empty()) throw ConfigError(place, reason + ", and " + other_integrator(only_linear) + remedy);
    scene = with(config, "corotational");
    return ChosenKinematics{{false, "corotational: " + reason}, build(scene), nullptr};
  };
  const double allowed = allowed_error(scene);
  scene = with(config, "corotational");
  BuiltScene exact = build(scene);
  scene = with(config, "linear");
  BuiltScene built = build(scene);
  if (!built.model->traits().linear) return corotational("loads, contact or supports are not linear anyway");
  const bool is_static = scene.analysis == Analysis::statical;
  const double end = is_static ? std::numeric_limits<double>::infinity() : scene.time.end;
  try {
    auto watch = std::make_unique<LinearityWatch>(*built.model, std::move(exact.model), scene.time.start, end, allowed,
                                                  only_linear);
    const StaticResponse response = linear_so_far
                                        ? StaticResponse{}
                                        : static_response(*built.model, built.initial, scene.time.end);
    if (response.exists()) {
      const Vector q = built.initial.q + (is_static ? 1 : kOvershoot) * response.displacement;
      if (const double error = watch->error_at(scene.time.end, q); error > kClearly * allowed)
        return corotational(fmt::format("linear kinematics would be off by {}{}, where {:.2g} is allowed",
                                        how_much(error), is_static ? "" : " at twice the static response", allowed),
                            ", or raise elasticity.linear_error");
    }
    config.set("elasticity.kinematics", std::string("auto"));
    config.set("elasticity.linear_error", allowed);
    return {{true, "linear"}, std::move(built), std::move(watch)};
  } catch (const RunError& e) {
    return corotational(e.what());
  }
}

}  // namespace orthodyn
