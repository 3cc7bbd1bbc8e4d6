// Arc-length continuation along a path of equilibria (q, lambda): a straight step along the tangent, then corrections
// in the plane perpendicular to it (Riks 1979), or at a fixed load factor where dlambda/ds > 0.5. The path may pass
// limit points and unstable equilibria.
//
// The arc length s is dimensionless: ds^2 = |dq|^2 / |dq/dlambda at the start|^2 + dlambda^2, so ds = sqrt(2) dlambda
// at the start. The last step ends exactly at lambda = 1.
#pragma once

#include <optional>

#include "lib/statics/equilibrium.h"

namespace orthodyn {

class PathTracer {
 public:
  // An equilibrium with its response, the unit tangent of the path, and the attempt that found it.
  struct PathState {
    PathPoint point;
    EquilibriumSolver::Response response;
    PathPoint tangent;
    EquilibriumSolver::Attempt attempt = {};
  };

  // Starts at lambda = 0. Both arguments must outlive this object. Throws RunError if K is singular at the start.
  PathTracer(const LoadPath& path, EquilibriumSolver& solver);

  const PathState& current() const { return current_; }

  // Finds the equilibrium at an arc length of about ds > 0 from the current one, or at lambda = 1 if that is nearer.
  // Empty if none is found or the path turns by more than 60 degrees; the step must then be shortened.
  std::optional<PathState> advance_by(double ds);

  // Finds an equilibrium whose displacement from the current one, projected on the direction of `shift`, is `shift`
  // (m). If `shift` is parallel to the null vector of K at a nearby bifurcation, the equilibrium lies on the other
  // branch. Its tangent points away from the current equilibrium. lambda is at most 1 on rising branches. Empty if none
  // is found or if it is far away.
  std::optional<PathState> branch_at(const Vector& shift);

  // Makes an equilibrium of advance_by() or branch_at() the current one.
  void move_to(PathState state) { current_ = std::move(state); }
  // Makes an equilibrium of any branch the current one; the path continues with increasing lambda. False if K is
  // singular there.
  bool move_to(const PathPoint& point, const EquilibriumSolver::Attempt& attempt);

  // Distance (arc length) of `there` from the current equilibrium: along the tangent, and in total.
  double arc_length_to(const PathPoint& there) const;
  double distance(const PathPoint& there) const { return distance(there, current_.point); }

  // |dq/dlambda| divided by its value at the start.
  double growth(const PathState& state) const { return space_.norm(state.response.rate) / length_; }

  // The last attempt of the solver.
  const EquilibriumSolver::Attempt& last_attempt() const { return attempt_; }

 private:
  double distance(const PathPoint& a, const PathPoint& b) const;
  std::optional<PathState> corrected_to_full_load(PathState past);
  bool complete(PathState& next);
  std::nullopt_t fail(const char* why);
  double product(const PathPoint& a, const PathPoint& b) const;
  PathPoint unit_tangent(const EquilibriumSolver::Response& response) const;

  EquilibriumSolver& solver_;
  VectorSpace space_;
  double length_ = 1;  // |dq/dlambda| at the start, m
  PathState current_;
  EquilibriumSolver::Attempt attempt_;
};

}  // namespace orthodyn
