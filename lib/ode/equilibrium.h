// An equilibrium solver finds where a model can rest: q with f(t, q, 0) = 0. One kind per file, chosen in
// the input by `type` through Registry<EquilibriumChoice>.
#pragma once

#include <memory>
#include <string>

#include "lib/config/registry.h"
#include "lib/ode/model.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

class EquilibriumSolver {
 public:
  struct Attempt {
    bool found = false;
    bool indefinite = false;  // given up since the stiffness was not positive definite on the way
    long iterations = 0;
    double residual = 0;  // N, the largest component of f
    bool above_tolerance = false;  // found, though round-off keeps the residual above its tolerance
    std::string failure_reason;  // why not found
  };

  virtual ~EquilibriumSolver() = default;

  // What may be found. nearby: an equilibrium on the branch of the guess; given up if Newton may have left it.
  // anywhere: any.
  enum class Where { nearby, anywhere };

  // q: the guess in, the equilibrium out if one is found, m. Throws RunError for failures that no other guess avoids.
  virtual Attempt solve(double t, Vector& q, Where where) = 0;

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
  // Throws ConfigError if the solver cannot serve the model, which must outlive it.
  virtual std::unique_ptr<EquilibriumSolver> make(const Model& model, const EquilibriumTask& task) const = 0;
};

}  // namespace orthodyn
