#include "lib/statics/path_tracer.h"

#include <cmath>
#include <utility>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr double kMostTurn = 0.5;  // cosine
constexpr double kSteep = 0.5;     // dlambda/ds above which a step is to a load factor: one solve less

PathPoint difference(const PathPoint& a, const PathPoint& b) { return {a.q - b.q, a.lambda - b.lambda}; }

}  // namespace

PathTracer::PathTracer(const LoadPath& path, EquilibriumSolver& solver) : solver_(solver), space_(path.space()) {
  const PathPoint start{path.start(), 0};
  auto response = solver.respond(start);
  if (!response)
    throw RunError("the stiffness is singular at the start: something is not held, or has no stiffness",
                   Reason::critical_point);
  if (const double length = space_.norm(response->rate); length > 0) length_ = length;
  place_ = {start, std::move(*response), {}, {}};
  place_.tangent = unit_tangent(place_.response);
}

double PathTracer::product(const PathPoint& a, const PathPoint& b) const {
  return space_.dot(a.q, b.q) / (length_ * length_) + a.lambda * b.lambda;
}

double PathTracer::along(const PathPoint& there) const {
  return product(place_.tangent, difference(there, place_.point));
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

std::optional<PathTracer::Place> PathTracer::beyond(double ds) {
  constexpr double kNear = 1e-9;
  const PathPoint& t = place_.tangent;
  PathPlane plane{Vector(t.q / (length_ * length_)), t.lambda};
  // What is left to lambda = 1, there without a sliver of a step after it.
  const double left = t.lambda > 0 ? (1 - place_.point.lambda) / t.lambda : 2 * ds + 1;
  if (left <= ds * (1 + kNear)) {
    ds = left;
    plane = {};
  }
  Place next;
  next.point = {place_.point.q + ds * t.q, place_.point.lambda + ds * t.lambda};
  if (left == ds) {
    next.point.lambda = 1;
  } else if (t.lambda > kSteep) {
    plane = {};
    next.point.lambda = std::round(1e12 * next.point.lambda) / 1e12;  // 0.25 rather than 0.25000000000000006
  }
  const PathPoint guess = next.point;
  attempt_ = solver_.solve(place_.point, next.point, plane);
  if (!attempt_.found) return std::nullopt;
  if (distance(next.point, guess) > ds) return refuse("Newton's corrections led far away");
  auto response = solver_.respond(next.point);
  if (!response) return refuse("the stiffness is singular, or cannot be evaluated");
  next.response = std::move(*response);
  next.tangent = unit_tangent(next.response);
  next.attempt = attempt_;
  double turn = product(next.tangent, t);
  if (turn < 0) {
    next.tangent.q *= -1;
    next.tangent.lambda *= -1;
    turn = -turn;
  }
  if (turn < kMostTurn) return refuse("the path turns sharply");
  return next.point.lambda > 1 && t.lambda > 0 ? back_to_one(std::move(next)) : next;
}

// From an equilibrium under more than all loads.
std::optional<PathTracer::Place> PathTracer::back_to_one(Place past) {
  PathPoint point{past.point.q + (1 - past.point.lambda) * past.response.rate, 1};
  const auto first = attempt_;
  attempt_ = solver_.solve(past.point, point, {});
  attempt_.iterations += first.iterations;
  if (!attempt_.found) return std::nullopt;
  auto response = solver_.respond(point);
  if (!response) return refuse("the stiffness is singular, or cannot be evaluated");
  const PathPoint tangent = unit_tangent(*response);
  return Place{std::move(point), std::move(*response), tangent, attempt_};
}

std::optional<PathTracer::Place> PathTracer::aside(const Vector& shift) {
  Place next;
  next.point = {place_.point.q + shift, place_.point.lambda};
  const PathPoint guess = next.point;
  attempt_ = solver_.solve(place_.point, next.point, {Vector(shift / space_.dot(shift, shift)), 0});
  if (!attempt_.found) return std::nullopt;
  if (distance(next.point, guess) > distance(guess)) return refuse("Newton's corrections led far away");
  auto response = solver_.respond(next.point);
  if (!response) return refuse("the stiffness is singular, or cannot be evaluated");
  next.response = std::move(*response);
  next.tangent = unit_tangent(next.response);
  next.attempt = attempt_;
  if (product(next.tangent, difference(next.point, place_.point)) < 0) {
    next.tangent.q *= -1;
    next.tangent.lambda *= -1;
  }
  return next.point.lambda > 1 && next.tangent.lambda > 0 ? back_to_one(std::move(next)) : next;
}

std::nullopt_t PathTracer::refuse(const char* why) {
  attempt_.found = false;
  attempt_.failure_reason = why;
  return std::nullopt;
}

bool PathTracer::move_to(const PathPoint& elsewhere, const EquilibriumSolver::Attempt& attempt) {
  auto response = solver_.respond(elsewhere);
  if (!response) return false;
  place_ = {elsewhere, std::move(*response), {}, attempt};
  place_.tangent = unit_tangent(place_.response);
  return true;
}

}  // namespace orthodyn
