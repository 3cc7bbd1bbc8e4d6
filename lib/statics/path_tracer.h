// A path of equilibria (q, lambda), followed by straight steps along its tangent and corrections on the plane
// perpendicular to it (Riks 1979), so that it may turn: past limit points, along unstable equilibria.
//
// Lengths s along the path are of (q / |dq/dlambda at the start|, lambda), free of units: at the start, ds = sqrt(2)
// dlambda. The last step ends at lambda = 1 exactly.
#pragma once

#include <optional>
#include <string>

#include "lib/statics/equilibrium.h"

namespace orthodyn {

class PathTracer {
 public:
  // An equilibrium, what K tells there, the unit tangent, and what led there.
  struct Place {
    PathPoint point;
    EquilibriumSolver::Response response;
    PathPoint tangent;
    EquilibriumSolver::Attempt attempt = {};
  };

  // At the start of the path, where lambda = 0. Both must outlive it. Throws RunError where K is singular there.
  PathTracer(const LoadPath& path, EquilibriumSolver& solver);

  const Place& place() const { return place_; }

  // The next equilibrium, ds along the path; none where it was not found, or where the path turned by more than 60
  // degrees on the way: a shorter step may help.
  std::optional<Place> beyond(double ds);

  // An equilibrium whose displacement from the present place has `shift`, m, along itself: on the path that crosses
  // this one near here, if `shift` is along the null vector of K at the crossing. Its tangent leads away from here.
  // Where that path rises beyond lambda = 1, its equilibrium at 1. None where it was not found or is far away.
  std::optional<Place> aside(const Vector& shift);

  // To an equilibrium found by beyond() or aside(); or to one on whatever branch, from where lambda rises.
  void move_to(Place place) { place_ = std::move(place); }
  bool move_to(const PathPoint& elsewhere, const EquilibriumSolver::Attempt& attempt);

  // How far `there` is from the present place: along its tangent, and altogether.
  double along(const PathPoint& there) const;
  double distance(const PathPoint& there) const { return distance(there, place_.point); }

  // |dq/dlambda| against that at the start.
  double growth(const Place& place) const { return space_.norm(place.response.rate) / length_; }

  // The last call of the solver.
  const EquilibriumSolver::Attempt& attempt() const { return attempt_; }

 private:
  double distance(const PathPoint& a, const PathPoint& b) const;
  std::optional<Place> back_to_one(Place past);
  std::nullopt_t refuse(const char* why);
  double product(const PathPoint& a, const PathPoint& b) const;
  PathPoint unit_tangent(const EquilibriumSolver::Response& response) const;

  EquilibriumSolver& solver_;
  VectorSpace space_;
  double length_ = 1;  // m, of dq/dlambda at the start
  Place place_;
  EquilibriumSolver::Attempt attempt_;
};

}  // namespace orthodyn
