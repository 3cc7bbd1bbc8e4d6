#include "lib/statics/load_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr long kFewIterations = 4, kManyIterations = 8;  // Newton iterations
constexpr double kBracket = 1e-3;     // bracket of a critical point, relative to the step that passed it
constexpr double kGap = 0.1;          // a larger final bracket, relative to that step, is a gap between two paths
constexpr int kMaxBisections = 30;    // steps to locate a critical point
constexpr double kSharpTurn = 30;     // |dq/dlambda| relative to the start, above which the path turns sharply
constexpr double kNear = 0.1;         // difference in load factor below which a turn belongs to a critical point
constexpr double kLowestFactor = -1;  // load factor at which following a path is given up

}  // namespace

LoadStepper::LoadStepper(const LoadPath& path, EquilibriumSolver& solver, const LoadStepping& stepping, double length)
    : path_(path),
      solver_(solver),
      stepping_(stepping),
      length_(length),
      state_{0, path.start(), Vector::Zero(path.num_dofs())} {}

void LoadStepper::begin() {
  tracer_.emplace(path_, solver_);
  const double length_of_factor = 1 / tracer_->current().tangent.lambda;  // ds / dlambda
  // Largest displacement (m) of the linear response to all loads.
  const double moves = path_.space().largest_entry(tracer_->current().response.rate);
  step_ =
      std::min(stepping_.first_step, moves > 0 && !path_.traits().linear ? length_ / moves : 1.0) * length_of_factor;
  smallest_step_ = std::min(stepping_.min_step * length_of_factor, step_ / 64);
  if (tracer_->current().response.unstable.value_or(0) > 0)
    throw RunError("the body is unstable before it is loaded: its stiffness at the start is indefinite",
                   Reason::critical_point);
}

StepInfo LoadStepper::step() {
  if (!tracer_) begin();
  check_limits();
  const double from = state_.t;
  advance();
  ++steps_;
  update_state();
  return {state_.t, state_.t - from, 1};
}

void LoadStepper::advance() {
  if (jumps_next_) return jump_or_stop();
  for (;;) {
    const double slope = std::abs(tracer_->current().tangent.lambda);
    if (slope > 0) step_ = std::min(step_, stepping_.max_step / slope);
    auto next = tracer_->advance_by(step_);
    passes_through_ = next && may_pass_through(*next);
    if (next && !passes_through_ && !exceeds_max_step(*next)) {
      if (!crosses_critical_point(*next)) {
        record_sharp_turn(*next);
        tracer_->move_to(std::move(*next));
        return adapt_step();
      }
      pass_critical_point(std::move(*next));
      if (has_advanced()) return;
      if (jumps_next_) return jump_or_stop();
      if (stops_next_) stop_at(critical_.back());
    }
    ++rejected_;
    if (step_ <= smallest_step_) give_up();
    step_ = std::max(step_ / 2, smallest_step_);
  }
}

// True if the load factor grew more than the tangent predicted, because the path bends upwards.
bool LoadStepper::exceeds_max_step(const PathState& next) const {
  return std::abs(next.point.lambda - tracer_->current().point.lambda) > 1.5 * stepping_.max_step;
}

// True if a body may pass through another one on the straight way to `next`: as a motion of one second, this way needs
// no reserve for velocities that grow.
bool LoadStepper::may_pass_through(const PathState& next) const {
  constexpr double kReserve = 0.4;  // in Model::longest_step()
  const PathPoint& here = tracer_->current().point;
  return path_.longest_step({path_.times().at(here.lambda), here.q, next.point.q - here.q}) < kReserve;
}

// Records the point of a sharp turn at which displacements grow fastest.
void LoadStepper::record_sharp_turn(const PathState& next) {
  const PathState& here = tracer_->current();
  const double growth = tracer_->growth(next);
  if (!(growth > kSharpTurn) || next.response.unstable.value_or(0) > 0) return;
  const CriticalPoint turn{CriticalPoint::Kind::turn, next.point.lambda,
                           std::abs(next.point.lambda - here.point.lambda), next.response.unstable};
  if (tracer_->growth(here) <= kSharpTurn) {
    critical_.push_back(turn);
  } else if (!critical_.empty() && critical_.back().kind == CriticalPoint::Kind::turn && growth > steepest_) {
    critical_.back() = turn;
  } else {
    return;
  }
  steepest_ = growth;
}

// Changes the step according to the number of iterations. If halving the step did not reduce their number, the step
// length is not the cause and the step grows again.
void LoadStepper::adapt_step() {
  const long iterations = tracer_->current().attempt.iterations;
  const bool halving_was_useless = was_halved_ && iterations >= iterations_;
  was_halved_ = false;
  if (iterations <= kFewIterations || (iterations > kManyIterations && halving_was_useless)) {
    step_ *= 2;
  } else if (iterations > kManyIterations) {
    step_ /= 2;
    was_halved_ = true;
  }
  iterations_ = iterations;
  step_ = std::max(step_, smallest_step_);
}

bool LoadStepper::has_advanced() const {
  const PathPoint& here = tracer_->current().point;
  return here.lambda != state_.t || path_.space().any(here.q != state_.q);
}

void LoadStepper::update_state() { state_ = {tracer_->current().point.lambda, tracer_->current().point.q, state_.v}; }

bool LoadStepper::crosses_critical_point(const PathState& next) const {
  if (turns_back(next)) return true;
  // An iterative solver detects only that K is indefinite; if the number is unknown, K counts as definite.
  return tracer_->current().response.unstable.value_or(0) != next.response.unstable.value_or(0);
}

// Locates the critical point between the current equilibrium and `beyond`. Moves to the last equilibrium before it and
// returns the first equilibrium found past it. Empty if there is no critical point, because a long step led to another
// path.
std::optional<PathTracer::PathState> LoadStepper::locate_critical_point(PathState beyond) {
  const auto shorten_step = [&] {
    step_ = std::max(step_ / 4, smallest_step_);
    return std::nullopt;
  };
  const double whole = tracer_->arc_length_to(beyond.point), close = kBracket * whole;
  for (int k = 0; k < kMaxBisections; ++k) {
    const double left = tracer_->arc_length_to(beyond.point);
    if (!(left > 0) || tracer_->distance(beyond.point) > 3 * left) return shorten_step();
    step_ = left;
    if (left <= std::max(close, smallest_step_)) break;
    const double a = tracer_->current().response.stiffness, b = beyond.response.stiffness;
    const double share = a * b < 0 ? std::clamp(a / (a - b), 0.1, 0.9) : 0.5;
    auto next = tracer_->advance_by(share * left);
    if (!next) next = tracer_->advance_by(0.1 * share * left);
    if (!next) break;
    if (crosses_critical_point(*next)) beyond = std::move(*next);
    else tracer_->move_to(std::move(*next));
  }
  const bool is_gap =
      !turns_back(beyond) && tracer_->arc_length_to(beyond.point) > kGap * whole && step_ > smallest_step_;
  if (is_gap) return shorten_step();
  return beyond;
}

// True if a limit point lies between the current equilibrium and `next`.
bool LoadStepper::turns_back(const PathState& next) const {
  return tracer_->current().tangent.lambda * next.tangent.lambda < 0;
}

// A limit point is at the top of the parabola with the slopes dlambda/ds at both ends. A bifurcation is where the
// linearly interpolated stiffness is zero.
CriticalPoint LoadStepper::critical_point_before(const PathState& beyond) const {
  const PathState& here = tracer_->current();
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

void LoadStepper::pass_critical_point(PathState beyond) {
  const double step = step_;
  auto past = locate_critical_point(std::move(beyond));
  if (!past) return;
  const CriticalPoint point = critical_point_before(*past);
  const auto is_before_it = [&](const CriticalPoint& turn) {
    return turn.kind == CriticalPoint::Kind::turn && std::abs(turn.load_factor - point.load_factor) < kNear;
  };
  if (!critical_.empty() && is_before_it(critical_.back())) critical_.pop_back();
  critical_.push_back(point);
  step_ = step;
  const bool loses_stability = tracer_->current().response.unstable.value_or(0) == 0;
  if (stepping_.at_limit == AtLimit::follow || !loses_stability) tracer_->move_to(std::move(*past));
  else if (stepping_.at_limit == AtLimit::jump) jumps_next_ = true;
  else stops_next_ = true;
}

// Jumps from the last equilibrium before a critical point, which the caller has already seen; throws if that fails.
void LoadStepper::jump_or_stop() {
  jumps_next_ = false;
  if (!jump()) stop_at(critical_.back());
  ++jumps_;
}

void LoadStepper::check_limits() const {
  if (stops_next_) stop_at(critical_.back());
  if (state_.t < kLowestFactor)
    throw RunError(
        fmt::format("the path descends to load factor {:.6g}, away from 1 (statics.at_limit: follow)", state_.t),
        Reason::critical_point);
  if (steps_ >= stepping_.max_steps)
    throw RunError(
        fmt::format("gave up at load factor {:.6g} after {} steps (statics.max_steps); raise it, or statics.max_step",
                    state_.t, steps_),
        Reason::too_many_steps);
}

// At a bifurcation tries the other branch first, if it is stable. Otherwise minimises the energy at a load factor a
// little past the critical point, then farther.
bool LoadStepper::jump() {
  if (critical_.back().kind == CriticalPoint::Kind::bifurcation && branch_off()) return true;
  const double from = critical_.back().load_factor;
  for (const double step : {0.05 * std::abs(from), stepping_.first_step})
    if (descend_to_equilibrium(std::min(1.0, from + step))) return true;
  return false;
}

bool LoadStepper::branch_off() {
  const Vector& weakest = tracer_->current().response.weakest;
  const Vector mode = length_ / path_.space().largest_entry(weakest) * weakest;
  for (const double share : {0.02, 0.1, 0.005})  // relative to the size of the motion
    for (const double side : {1.0, -1.0})        // for an unsymmetric body only one side is stable
      if (move_to_branch(side * share * mode)) return true;
  return false;
}

bool LoadStepper::move_to_branch(const Vector& shift) {
  auto next = tracer_->branch_at(shift);
  if (!next || next->response.unstable.value_or(0) > 0 || !(next->tangent.lambda > 0)) return false;
  step_ = tracer_->distance(next->point);
  tracer_->move_to(std::move(*next));
  return true;
}

// Minimises the energy from a state displaced along the weakest direction; repeats this while the result is unstable.
bool LoadStepper::descend_to_equilibrium(double load_factor) {
  constexpr double kPush = 0.1;  // relative to the size of the motion
  constexpr int kPushes = 4;
  PathPoint point = tracer_->current().point;
  Vector aside = tracer_->current().response.weakest;
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
    throw RunError(fmt::format("limit point at {}: the load cannot increase further on this path; the body snaps "
                               "through. Use analysis: dynamic for the motion that follows; statics.at_limit: follow "
                               "continues along the path of unstable equilibria, {}",
                               where, tried),
                   Reason::critical_point);
  throw RunError(
      fmt::format(
          "bifurcation at {}: the equilibria beyond it are unstable, and the body buckles sideways. statics.at_limit: "
          "follow stays on this path, {}; a small sideways load turns the bifurcation into a smooth path",
          where, tried),
      Reason::critical_point);
}

void LoadStepper::give_up() const {
  if (const auto& attempt = tracer_->last_attempt(); attempt.names_remedy && !attempt.found && !passes_through_)
    throw RunError(
        fmt::format("no equilibrium was found beyond load factor {:.6g}: {}", state_.t, attempt.failure_reason),
        Reason::newton);
  throw RunError(fmt::format("no equilibrium was found beyond load factor {:.6g}, with steps down to {:.2g} "
                             "(statics.min_step): {}. This does not mean that none exists: reduce statics.min_step or "
                             "the loads, or compute the damped motion to rest (analysis: dynamic)",
                             state_.t, stepping_.min_step,
                             passes_through_                 ? "bodies would pass through each other"
                             : tracer_->last_attempt().found ? "another path is too close to be distinguished"
                                                             : tracer_->last_attempt().failure_reason),
                 Reason::newton);
}

}  // namespace orthodyn
