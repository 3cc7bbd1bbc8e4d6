#include "lib/statics/load_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr long kEasy = 4, kHard = 8;  // Newton iterations
constexpr double kBracket = 1e-3;     // of the step in which a critical point was met
constexpr int kMostCloser = 30;       // steps towards a critical point
constexpr double kGap = 0.1;          // of that step: what it cannot be closed in to is a gap between two paths
constexpr double kTurn = 30;          // growth of displacements with the load, against that at the start
constexpr double kNear = 0.1;         // of load factors: a turn that leads up to a critical point
constexpr double kLowestFactor = -1;

}  // namespace

LoadStepper::LoadStepper(const LoadPath& path, EquilibriumSolver& solver, const LoadStepping& stepping, double length)
    : path_(path),
      solver_(solver),
      stepping_(stepping),
      length_(length),
      state_{0, path.start(), Vector::Zero(path.num_dofs())} {}

void LoadStepper::begin() {
  tracer_.emplace(path_, solver_);
  const double length_of_factor = 1 / tracer_->place().tangent.lambda;
  const double moves = path_.space().largest_entry(tracer_->place().response.rate);  // m, by all loads, if linear
  step_ =
      std::min(stepping_.first_step, moves > 0 && !path_.traits().linear ? length_ / moves : 1.0) * length_of_factor;
  smallest_step_ = std::min(stepping_.min_step * length_of_factor, step_ / 64);
  if (tracer_->place().response.unstable.value_or(0) > 0)
    throw RunError("the body is unstable before it is loaded: its stiffness at the start is indefinite",
                   Reason::critical_point);
}

StepInfo LoadStepper::step() {
  if (!tracer_) begin();
  require_going_on();
  const double from = state_.t;
  advance();
  ++steps_;
  arrive();
  return {state_.t, state_.t - from, 1};
}

void LoadStepper::advance() {
  if (leaves_ && leave()) return;
  for (;;) {
    const double slope = std::abs(tracer_->place().tangent.lambda);
    if (slope > 0) step_ = std::min(step_, stepping_.max_step / slope);
    auto next = tracer_->beyond(step_);
    if (next && !passes_over_too_much(*next)) {
      if (!crosses_critical_point(*next)) {
        note_turn(*next);
        tracer_->move_to(std::move(*next));
        return adapt();
      }
      pass_critical_point(std::move(*next));
      if (has_moved() || (leaves_ && leave())) return;
      if (stops_) stop_at(critical_.back());
    }
    ++rejected_;
    if (step_ <= smallest_step_) give_up();
    shorten();
  }
}

// The path bends upwards: its tangent promised less.
bool LoadStepper::passes_over_too_much(const Place& next) const {
  return std::abs(next.point.lambda - tracer_->place().point.lambda) > 1.5 * stepping_.max_step;
}

// Where displacements grow fastest.
void LoadStepper::note_turn(const Place& next) {
  const Place& here = tracer_->place();
  const double growth = tracer_->growth(next);
  if (!(growth > kTurn) || next.response.unstable.value_or(0) > 0) return;
  const CriticalPoint turn{CriticalPoint::Kind::turn, next.point.lambda,
                           std::abs(next.point.lambda - here.point.lambda), next.response.unstable};
  if (tracer_->growth(here) <= kTurn) {
    critical_.push_back(turn);
  } else if (!critical_.empty() && critical_.back().kind == CriticalPoint::Kind::turn && growth > steepest_) {
    critical_.back() = turn;
  } else {
    return;
  }
  steepest_ = growth;
}

// Where a shorter step took no fewer iterations than the one before, its length is not what makes them many.
void LoadStepper::adapt() {
  const long iterations = tracer_->place().attempt.iterations;
  const bool was_in_vain = was_halved_ && iterations >= iterations_;
  was_halved_ = false;
  if (iterations <= kEasy || (iterations > kHard && was_in_vain)) {
    step_ *= 2;
  } else if (iterations > kHard) {
    step_ /= 2;
    was_halved_ = true;
  }
  iterations_ = iterations;
  step_ = std::max(step_, smallest_step_);
}

void LoadStepper::shorten() { step_ = std::max(step_ / 2, smallest_step_); }

bool LoadStepper::has_moved() const {
  const PathPoint& here = tracer_->place().point;
  return here.lambda != state_.t || path_.space().any(here.q != state_.q);
}

void LoadStepper::arrive() { state_ = {tracer_->place().point.lambda, tracer_->place().point.q, state_.v}; }

bool LoadStepper::crosses_critical_point(const Place& next) const {
  if (turns_back(next)) return true;
  // An iterative solver tells of an indefinite K only; where none does, it is taken to be definite.
  return tracer_->place().response.unstable.value_or(0) != next.response.unstable.value_or(0);
}

// Moves to the last equilibrium before a critical point that lies between here and there, and returns the first one
// found past it. None where there is no such point: `beyond` lies on another path, to which a long step led.
std::optional<PathTracer::Place> LoadStepper::close_in(Place beyond) {
  const double whole = tracer_->along(beyond.point), close = kBracket * whole;
  for (int k = 0; k < kMostCloser; ++k) {
    const double left = tracer_->along(beyond.point);
    if (!(left > 0) || tracer_->distance(beyond.point) > 3 * left) {
      step_ = std::max(step_ / 4, smallest_step_);
      return std::nullopt;
    }
    step_ = left;
    if (left <= std::max(close, smallest_step_)) break;
    const double a = tracer_->place().response.stiffness, b = beyond.response.stiffness;
    const double share = a * b < 0 ? std::clamp(a / (a - b), 0.1, 0.9) : 0.5;
    auto next = tracer_->beyond(share * left);
    if (!next) next = tracer_->beyond(0.1 * share * left);
    if (!next) break;
    if (crosses_critical_point(*next)) beyond = std::move(*next);
    else tracer_->move_to(std::move(*next));
  }
  const bool is_gap = !turns_back(beyond) && tracer_->along(beyond.point) > kGap * whole && step_ > smallest_step_;
  if (!is_gap) return beyond;
  step_ = std::max(step_ / 4, smallest_step_);
  return std::nullopt;
}

// A limit point lies between.
bool LoadStepper::turns_back(const Place& next) const {
  return tracer_->place().tangent.lambda * next.tangent.lambda < 0;
}

// Of a limit point the top of the parabola with the slopes at both ends, else where the stiffness crosses zero along a
// straight line.
CriticalPoint LoadStepper::critical_point_before(const Place& beyond) const {
  const Place& here = tracer_->place();
  const double la = here.point.lambda, lb = beyond.point.lambda;
  if (turns_back(beyond)) {
    const double ds = tracer_->distance(beyond.point),
                 share = here.tangent.lambda / (here.tangent.lambda - beyond.tangent.lambda);
    const double peak = la + 0.5 * here.tangent.lambda * share * ds;
    return {CriticalPoint::Kind::limit, peak, std::abs(here.tangent.lambda) * share * ds, beyond.response.unstable};
  }
  const double a = here.response.stiffness, b = beyond.response.stiffness;
  const double share = a * b < 0 ? a / (a - b) : 0.5;
  return {CriticalPoint::Kind::bifurcation, la + share * (lb - la), std::abs(lb - la), beyond.response.unstable};
}

void LoadStepper::pass_critical_point(Place beyond) {
  const double step = step_;
  auto past = close_in(std::move(beyond));
  if (!past) return;
  const CriticalPoint point = critical_point_before(*past);
  const auto is_before_it = [&](const CriticalPoint& turn) {
    return turn.kind == CriticalPoint::Kind::turn && std::abs(turn.load_factor - point.load_factor) < kNear;
  };
  if (!critical_.empty() && is_before_it(critical_.back())) critical_.pop_back();
  critical_.push_back(point);
  step_ = step;
  const bool leaves_stability = tracer_->place().response.unstable.value_or(0) == 0;
  if (stepping_.at_limit == AtLimit::follow || !leaves_stability) tracer_->move_to(std::move(*past));
  else if (stepping_.at_limit == AtLimit::jump) leaves_ = true;
  else stops_ = true;
}

// From the last equilibrium before a critical point, which has been told.
bool LoadStepper::leave() {
  leaves_ = false;
  if (!jump()) stop_at(critical_.back());
  ++jumps_;
  return true;
}

void LoadStepper::require_going_on() const {
  if (stops_) stop_at(critical_.back());
  if (state_.t < kLowestFactor)
    throw RunError(
        fmt::format("the path leads down to load factor {:.6g}, away from 1 (statics.at_limit: follow)", state_.t),
        Reason::critical_point);
  if (steps_ >= stepping_.max_steps)
    throw RunError(fmt::format("gave up at load factor {:.6g} after {} steps (statics.max_steps); raise it, or "
                               "statics.max_step",
                               state_.t, steps_),
                   Reason::too_many_steps);
}

// Where the path goes on the body leaves along another one that crosses it, if that is stable; else it falls to where
// it rests: a little past the critical point, then far.
bool LoadStepper::jump() {
  if (critical_.back().kind == CriticalPoint::Kind::bifurcation && branch_off()) return true;
  const double from = critical_.back().load_factor;
  for (const double step : {0.05 * std::abs(from), stepping_.first_step})
    if (settle(std::min(1.0, from + step))) return true;
  return false;
}

bool LoadStepper::branch_off() {
  const Vector& weakest = tracer_->place().response.weakest;
  const Vector mode = length_ / path_.space().largest_entry(weakest) * weakest;
  for (const double share : {0.02, 0.1, 0.005})  // of the motion's size
    for (const double side : {1.0, -1.0})        // of an unsymmetric body one only is stable
      if (move_aside(side * share * mode)) return true;
  return false;
}

bool LoadStepper::move_aside(const Vector& shift) {
  auto next = tracer_->aside(shift);
  if (!next || next->response.unstable.value_or(0) > 0 || !(next->tangent.lambda > 0)) return false;
  step_ = tracer_->distance(next->point);
  tracer_->move_to(std::move(*next));
  return true;
}

// Pushed aside along the weakest direction, each time that it rests where it is unstable.
bool LoadStepper::settle(double load_factor) {
  constexpr double kPush = 0.1;  // of the motion's size
  constexpr int kPushes = 4;
  PathPoint point = tracer_->place().point;
  Vector aside = tracer_->place().response.weakest;
  point.lambda = load_factor;
  for (int k = 0; k < kPushes; ++k) {
    point.q += kPush * length_ / path_.space().largest_entry(aside) * aside;
    const auto attempt = solver_.descend(point);
    if (!attempt.found) return false;
    const auto response = solver_.respond(point);
    if (response && response->unstable.value_or(0) == 0) {
      step_ = kPush * tracer_->distance(point);
      return tracer_->move_to(point, attempt);
    }
    if (response) aside = response->weakest;
  }
  return false;
}

void LoadStepper::stop_at(const CriticalPoint& point) const {
  const std::string where = fmt::format("load factor {:.6g} +- {:.2g}", point.load_factor, point.uncertainty);
  const char* const tried = stepping_.at_limit == AtLimit::jump
                                ? "no stable equilibrium was found elsewhere (statics.at_limit: jump)"
                                : "statics.at_limit: jump looks for a stable equilibrium elsewhere";
  if (point.kind == CriticalPoint::Kind::limit)
    throw RunError(fmt::format("limit point at {}: the body carries no more on this path, and snaps through. What "
                               "follows is a motion (analysis: dynamic); statics.at_limit: follow goes on along the "
                               "path of unstable equilibria, {}",
                               where, tried),
                   Reason::critical_point);
  throw RunError(fmt::format("bifurcation at {}: the equilibria go on, but are unstable; the body buckles sideways. "
                             "statics.at_limit: follow stays on this path, {}; a small sideways load turns the "
                             "bifurcation into a smooth path",
                             where, tried),
                 Reason::critical_point);
}

void LoadStepper::give_up() const {
  throw RunError(
      fmt::format(
          "no equilibrium was found beyond load factor {:.6g}, with steps down to {:.2g} "
          "(statics.min_step): {}. This says nothing about the body: lower statics.min_step or the loads, or "
          "let the body come to rest in time with damping (analysis: dynamic)",
          state_.t, stepping_.min_step,
          tracer_->attempt().found ? "another path is too near to be told apart" : tracer_->attempt().failure_reason),
      Reason::newton);
}

}  // namespace orthodyn
