// Direct solvers for sparse linear systems, factored many times on one pattern. One kind per file,
// chosen in the input by name through solver_registry().
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "lib/core/pattern.h"

namespace orthodyn {

enum class FactorStatus { ok, not_positive_definite, singular };

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  // Prepares for matrices on this pattern, which must outlive the solver. Throws RunError when
  // memory does not suffice.
  virtual void analyze(const Pattern& pattern) = 0;

  // Factors new values on the analysed pattern. A solver that does not look at definiteness never
  // answers not_positive_definite.
  virtual FactorStatus factor(const double* values) = 0;

  // x = A^-1 b. x and b may be the same.
  virtual void solve(const ConstVectorRef& b, VectorRef x) = 0;

  // Bytes taken at the peak of a factorisation: the factor and the solver's workspace. After analyze()
  // a prediction.
  virtual std::size_t factor_bytes() const = 0;

  // What was chosen at analysis, e.g. "supernodal, nested dissection".
  virtual std::string description() const = 0;
};

struct SolverKind {
  std::string sentence;
  bool takes_general;  // unsymmetric matrices
  std::function<std::unique_ptr<LinearSolver>()> make;
};

std::map<std::string, SolverKind>& solver_registry();

}  // namespace orthodyn
