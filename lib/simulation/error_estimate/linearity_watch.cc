#include "lib/simulation/error_estimate/linearity_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/core/spelling.h"
#include "lib/simulation/error_estimate/mass_norm.h"

namespace orthodyn {

namespace {

constexpr double kUncheckedGrowth = 0.5;  // predicted over allowed error at which the error is computed again
constexpr double kLeastGrowth = 1.05, kLargestGrowth = 2;  // of the displacement between two computations of the error
constexpr double kTinyError = 1e-300;                      // avoids a division by zero
constexpr double kOutOfPhase = 2;                          // largest relative error of two motions out of phase
constexpr double kHopeless = 1;                            // relative error above which the phase error is not computed

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

std::string linearity_error_message(const LinearityWatch& watch) {
  if (watch.unstable()) return kBucklesBelowLoads;
  return fmt::format("linear kinematics are off by {} at t = {:.6g} s, where {:.3g} is allowed",
                     linearity_error_text(watch.error()), watch.time(), watch.allowed());
}

}  // namespace

std::string linearity_error_text(double error, const char* format) {
  return std::isfinite(error) ? "about " + fmt::format(fmt::runtime(format), error) + " of the motion"
                              : std::string("an amount that could not be estimated");
}

std::string other_integrator(const std::string& only_linear) {
  return only_linear + " is for linear kinematics only: use another integrator, such as cvode_bdf";
}

LinearityWatch::LinearityWatch(const FemModel& model, std::vector<LinearRegion> regions, double start, double end,
                               double allowed, std::string only_linear)
    : model_(model),
      regions_(std::move(regions)),
      allowed_(allowed),
      span_(end - start),
      time_(start),
      largest_{start, 0, Vector::Zero(model.num_dofs())},
      only_linear_(std::move(only_linear)) {
  if (std::isfinite(span_)) phase_.emplace(model, start);
}

bool LinearityWatch::covers_all_regions() const { return terms_of(regions_).size() == model_.parts().elastic.size(); }

Linearity& LinearityWatch::linearity() {
  if (!linearity_) linearity_.emplace(model_, terms_of(regions_), span_);
  return *linearity_;
}

void LinearityWatch::update_error(double t, const Vector& q) {
  checked_ = mass_norm(model_, q);
  const LinearityError found = linearity().error(t, q);
  local_ = std::max(local_, found.displacement);
  stiffness_ = std::max(stiffness_, found.stiffness);
  unstable_ = unstable_ || found.unstable;
  error_ = std::max(error_, local_);
}

void LinearityWatch::finish_at(double t, const Vector& q) {
  time_ = t;
  largest_ = {t, mass_norm(model_, q), q};
  finish();
}

void LinearityWatch::require(double t, const Vector& q) {
  if (!std::isfinite(allowed_)) return;
  finish_at(t, q);
  if (exceeds_allowed()) throw_exceeded();
}

void LinearityWatch::throw_exceeded() const {
  throw RunError(linearity_error_message(*this) + "; " +
                 (only_linear_.empty() ? "set elasticity.kinematics: corotational"
                                       : other_integrator(only_linear_) + ", or raise elasticity.linear_error"));
}

std::optional<KinematicsRestart> LinearityWatch::kinematics_restart() {
  if (!exceeds_allowed() || !only_linear_.empty()) return std::nullopt;
  return KinematicsRestart{corotational_regions(largest_.t, largest_.q), linearity_error_message(*this)};
}

void LinearityWatch::finish() {
  try {
    if (largest_.norm > checked_) update_error(largest_.t, largest_.q);
    const bool is_known = error_ < kHopeless;
    error_ = std::max(error_,
                      local_ + relative_phase_error(phase_ && is_known ? phase_->error_with_window(linearity()) : 0));
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
  largest_.norm = mass_norm(model_, largest_.q);
  if (phase_) phase_->restore(archive);
}

// Assumes that the error grows no faster than the square of the displacement.
double LinearityWatch::next_check() const {
  if (!std::isfinite(allowed_)) return allowed_;
  const double growth = std::sqrt(kUncheckedGrowth * allowed_ / std::max(local_, kTinyError));
  return std::clamp(growth, kLeastGrowth, kLargestGrowth) * checked_;
}

void LinearityWatch::observe(const State& state) {
  time_ = state.t;
  if (const double q = mass_norm(model_, state.q); q > largest_.norm) largest_ = {state.t, q, state.q};
  if (largest_.norm > next_check()) update_error(state.t, state.q);
  if (phase_) phase_->observe(state);
  if (phase_ && phase_->is_full()) update_phase_error();
  if (exceeds_allowed()) throw_exceeded();
}

void LinearityWatch::update_phase_error() {
  if (!(error_ < kHopeless)) return phase_->discard_window();
  try {
    phase_->integrate_window(linearity());
    error_ = std::max(error_, local_ + relative_phase_error(phase_->error()));
  } catch (const RunError&) {
    error_ = std::numeric_limits<double>::quiet_NaN();
  }
}

// Motions fully out of phase differ by at most twice their size.
double LinearityWatch::relative_phase_error(double phase) const {
  return largest_.norm > 0 ? std::min(phase / largest_.norm, kOutOfPhase) : 0;
}

double LinearityWatch::phase_error_of(double stiffness) const {
  if (!phase_ || !(stiffness_ > 0)) return 0;
  return relative_phase_error(phase_->error()) * std::min(stiffness / stiffness_, 1.0);
}

std::vector<std::string> LinearityWatch::corotational_regions(double t, const Vector& q) {
  std::vector<std::pair<double, std::string>> errors;
  for (const auto& [name, terms] : regions_) {
    const LinearityError found = linearity().error(t, q, terms);
    errors.emplace_back(found.displacement + phase_error_of(found.stiffness), name);
  }
  std::sort(errors.begin(), errors.end());
  std::vector<std::string> names{errors.back().second};
  errors.pop_back();
  double sum = 0;
  for (const auto& [error, name] : errors)
    if ((sum += error) > allowed_ / 2) names.push_back(name);
  return names;
}

std::string linearity_summary(const LinearityWatch& watch) {
  const std::string where = watch.covers_all_regions() ? "" : " in " + join(names_of(watch.regions()));
  if (std::isnan(watch.error())) return fmt::format("linear{}: the error is not known", where);
  if (watch.unstable()) return fmt::format("linear{}: {}", where, kBucklesBelowLoads);
  const bool is_watched = std::isfinite(watch.allowed());
  return fmt::format("linear{}: off by {}{}", where, linearity_error_text(watch.error(), "{:.1e}"),
                     is_watched ? fmt::format(", where {:.1e} is allowed", watch.allowed()) : "");
}

}  // namespace orthodyn
