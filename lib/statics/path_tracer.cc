#include "lib/statics/path_tracer.h"

#include <cmath>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr double kMinCosine = 0.5;  // least cosine of the angle between the tangents at both ends of a step
constexpr double kSteep = 0.5;      // above this dlambda/ds, a step has a fixed load factor, which saves a linear solve

PathPoint difference(const PathPoint& a, const PathPoint& b) { return {a.q - b.q, a.lambda - b.lambda}; }

void reverse(PathPoint& tangent) {
  tangent.q *= -1;
  tangent.lambda *= -1;
}

}  // namespace

PathTracer::PathTracer(const LoadPath& path, EquilibriumSolver& solver) : solver_(solver), space_(path.space()) {
  const PathPoint start{path.start(), 0};
  auto response = solver.respond(start);
  if (!response)
    throw RunError("the stiffness is singular at the start: some part is not supported, or has no stiffness",
                   Reason::critical_point);
  if (const double length = space_.norm(response->rate); length > 0) length_ = length;
  current_ = {start, std::move(*response), {}, {}};
  current_.tangent = unit_tangent(current_.response);
}

double PathTracer::product(const PathPoint& a, const PathPoint& b) const {
  return space_.dot(a.q, b.q) / (length_ * length_) + a.lambda * b.lambda;
}

double PathTracer::arc_length_to(const PathPoint& there) const {
  return product(current_.tangent, difference(there, current_.point));
}

double PathTracer::distance(const PathPoint& a, const PathPoint& b) const {
  const PathPoint d = difference(a, b);
  return std::sqrt(product(d, d));
}

PathPoint PathTracer::unit_tangent(const EquilibriumSolver::Response& response) const {
  PathPoint t{response.rate, 1};
  const double norm = std::sqrt(product(t, t));
  t.q /= norm;
  t.lambda /= norm;
  return t;
}

std::optional<PathTracer::PathState> PathTracer::advance_by(double ds) {
  constexpr double kNear = 1e-9;
  const PathPoint& t = current_.tangent;
  PathPlane plane{Vector(t.q / (length_ * length_)), t.lambda};
  // Arc length to lambda = 1. kNear avoids a tiny last step.
  const double left = t.lambda > 0 ? (1 - current_.point.lambda) / t.lambda : 2 * ds + 1;
  if (left <= ds * (1 + kNear)) {
    ds = left;
    plane = {};
  }
  PathState next;
  next.point = {current_.point.q + ds * t.q, current_.point.lambda + ds * t.lambda};
  if (left == ds) {
    next.point.lambda = 1;
  } else if (t.lambda > kSteep) {
    plane = {};
    next.point.lambda = std::round(1e12 * next.point.lambda) / 1e12;  // 0.25 rather than 0.25000000000000006
  }
  const PathPoint guess = next.point;
  attempt_ = solver_.solve(current_.point, next.point, plane);
  if (!attempt_.found) return std::nullopt;
  if (distance(next.point, guess) > ds) return fail("Newton's method converged to a distant equilibrium");
  if (!complete(next)) return std::nullopt;
  double turn = product(next.tangent, t);
  if (turn < 0) {
    reverse(next.tangent);
    turn = -turn;
  }
  if (turn < kMinCosine) return fail("the path turns sharply");
  return next.point.lambda > 1 && t.lambda > 0 ? corrected_to_full_load(std::move(next)) : next;
}

// The equilibrium at lambda = 1, starting from `past` with lambda > 1.
std::optional<PathTracer::PathState> PathTracer::corrected_to_full_load(PathState past) {
  PathState next;
  next.point = {past.point.q + (1 - past.point.lambda) * past.response.rate, 1};
  const auto first = attempt_;
  attempt_ = solver_.solve(past.point, next.point, {});
  attempt_.iterations += first.iterations;
  if (!attempt_.found || !complete(next)) return std::nullopt;
  return next;
}

std::optional<PathTracer::PathState> PathTracer::branch_at(const Vector& shift) {
  PathState next;
  next.point = {current_.point.q + shift, current_.point.lambda};
  const PathPoint guess = next.point;
  attempt_ = solver_.solve(current_.point, next.point, {Vector(shift / space_.dot(shift, shift)), 0});
  if (!attempt_.found) return std::nullopt;
  if (distance(next.point, guess) > distance(guess)) return fail("Newton's method converged to a distant equilibrium");
  if (!complete(next)) return std::nullopt;
  if (product(next.tangent, difference(next.point, current_.point)) < 0) reverse(next.tangent);
  return next.point.lambda > 1 && next.tangent.lambda > 0 ? corrected_to_full_load(std::move(next)) : next;
}

// Sets response, tangent and attempt of `next`. False if K is singular there.
bool PathTracer::complete(PathState& next) {
  auto response = solver_.respond(next.point);
  if (!response) {
    fail("the stiffness is singular, or cannot be evaluated");
    return false;
  }
  next.response = std::move(*response);
  next.tangent = unit_tangent(next.response);
  next.attempt = attempt_;
  return true;
}

std::nullopt_t PathTracer::fail(const char* why) {
  attempt_.found = false;
  attempt_.failure_reason = why;
  attempt_.names_remedy = false;
  return std::nullopt;
}

bool PathTracer::move_to(const PathPoint& point, const EquilibriumSolver::Attempt& attempt) {
  auto response = solver_.respond(point);
  if (!response) return false;
  current_ = {point, std::move(*response), {}, attempt};
  current_.tangent = unit_tangent(current_.response);
  return true;
}

}  // namespace orthodyn
