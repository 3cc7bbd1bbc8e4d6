// The interface of equilibrium solvers, which find positions q and a load factor lambda with f_lambda(q) = 0 on a path
// of equilibria (load_path.h). One type per file, chosen in the input by `type` through Registry<EquilibriumChoice>.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lib/config/registry.h"
#include "lib/ode/statistics.h"
#include "lib/statics/load_path.h"

namespace orthodyn {

// A point (q, lambda) of the path.
struct PathPoint {
  Vector q;           // m
  double lambda = 0;  // load factor
};

// The plane q . (x - x_guess) + lambda (l - l_guess) = 0 on which a solution is sought: x are its positions, l is its
// load factor, q and lambda are the coefficients below. q = 0 fixes the load factor.
struct PathPlane {
  std::optional<Vector> q;  // 1/m; empty for q = 0
  double lambda = 1;
};

class EquilibriumSolver {
 public:
  struct Attempt {
    bool found = false;
    long iterations = 0;
    double contraction = 0;        // |dq_1| / |dq_0| of the first two Newton corrections; 0 if there was only one
    double residual = 0;           // largest component of f, N
    bool above_tolerance = false;  // found, but round-off keeps the residual above its tolerance
    std::string failure_reason;    // empty if found
    bool names_remedy = false;     // failure_reason is the text of a LimitError, which tells the remedy
  };

  // Results of a factorisation of K at an equilibrium.
  struct Response {
    Vector rate;  // dq/dlambda = K^-1 df_lambda/dlambda, m
    // Number of unstable directions (negative eigenvalues of K); for an unsymmetric K modulo 2. Empty if unknown.
    std::optional<int> unstable;
    Vector weakest;  // K^-1 b for a fixed b without any symmetry; approximates the null vector of a nearly singular K
    double stiffness = 0;  // 1 / (b . K^-1 b): changes sign with an eigenvalue of K
  };

  virtual ~EquilibriumSolver() = default;

  // `point`: on input the guess, on output the equilibrium on the plane, if one is found. `before`: the equilibrium
  // from which a straight step led to the guess. Fails if Newton's corrections do not contract. Throws RunError for
  // failures that another guess cannot avoid.
  virtual Attempt solve(const PathPoint& before, PathPoint& point, const PathPlane& plane) = 0;

  // Minimises the energy from `point` at its load factor. The equilibrium found may lie on any branch.
  virtual Attempt descend(PathPoint& point) = 0;

  // Factors K at an equilibrium. Empty if K is singular or cannot be evaluated.
  virtual std::optional<Response> respond(const PathPoint& equilibrium) = 0;

  virtual const Statistics& statistics() const = 0;
  virtual std::size_t factor_bytes() const = 0;
  virtual std::string description() const = 0;  // description of the linear solver
};

struct EquilibriumTask {
  double force = 1;   // magnitude of the loads (N), the unit of residual tolerances
  double length = 1;  // magnitude of the displacements, m
};

class EquilibriumChoice {
 public:
  virtual ~EquilibriumChoice() = default;
  // True if the solver accepts models with unsymmetric K.
  virtual bool takes_unsymmetric() const { return false; }
  // Throws ConfigError if the solver does not accept the model. `path` must outlive the solver.
  virtual std::unique_ptr<EquilibriumSolver> make(const LoadPath& path, const EquilibriumTask& task) const = 0;
};

}  // namespace orthodyn
