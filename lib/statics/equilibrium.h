// An equilibrium solver finds where a model can rest: q with f_lambda(q) = 0, on a path of equilibria whose load factor
// lambda is an unknown like q (load_path.h). One kind per file, chosen in the input by `type` through
// Registry<EquilibriumChoice>.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lib/config/registry.h"
#include "lib/ode/statistics.h"
#include "lib/statics/load_path.h"

namespace orthodyn {

// A point of the path; its load factor is `lambda`.
struct PathPoint {
  Vector q;  // m
  double lambda = 0;
};

// The plane q . (x - guess) + lambda (l - guess's) = 0 that a solution is to lie on: q = 0 fixes the load factor.
struct PathPlane {
  std::optional<Vector> q;  // 1/m; none for 0
  double lambda = 1;
};

class EquilibriumSolver {
 public:
  struct Attempt {
    bool found = false;
    long iterations = 0;
    double contraction = 0;        // |dq_1| / |dq_0| of Newton's corrections; 0 where there was one
    double residual = 0;           // N, the largest component of f
    bool above_tolerance = false;  // found, though round-off keeps the residual above its tolerance
    std::string failure_reason;    // why not found
  };

  // What K tells at an equilibrium.
  struct Response {
    Vector rate;  // dq/dlambda = K^-1 f_lambda', m
    // Negative eigenvalues of K: directions in which the body leaves; of an unsymmetric K 1 if their number is odd,
    // else 0. None: not known.
    std::optional<int> unstable;
    Vector weakest;  // K^-1 b for a fixed b that is in no body's symmetry: where K is nearly singular, its null vector
    double stiffness = 0;  // 1 / (b . K^-1 b): crosses zero with an eigenvalue of K
  };

  virtual ~EquilibriumSolver() = default;

  // `point`: the guess in, the equilibrium on the plane out if one is found. `before`: the equilibrium from which the
  // guess is a straight step. Given up where Newton's corrections do not contract. Throws RunError for failures that no
  // other guess avoids.
  virtual Attempt solve(const PathPoint& before, PathPoint& point, const PathPlane& plane) = 0;

  // Down the energy from `point`, at its load factor, to an equilibrium on whatever branch.
  virtual Attempt descend(PathPoint& point) = 0;

  // None where K is singular or cannot be evaluated.
  virtual std::optional<Response> respond(const PathPoint& equilibrium) = 0;

  virtual const Statistics& statistics() const = 0;
  virtual std::size_t factor_bytes() const = 0;
  virtual std::string description() const = 0;  // of its linear solver
};

struct EquilibriumTask {
  double force = 1;   // N, the size of the loads: what residuals are relative to
  double length = 1;  // m, the size of the motion
};

class EquilibriumChoice {
 public:
  virtual ~EquilibriumChoice() = default;
  // Whether it serves models whose K is unsymmetric.
  virtual bool takes_unsymmetric() const { return false; }
  // Throws ConfigError if the solver cannot serve the model, which must outlive it.
  virtual std::unique_ptr<EquilibriumSolver> make(const LoadPath& path, const EquilibriumTask& task) const = 0;
};

}  // namespace orthodyn
