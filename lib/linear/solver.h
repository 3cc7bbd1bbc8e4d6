// Direct solvers for sparse linear systems A x = b, factored many times on one pattern. One kind per file, chosen in
// the input by name through solver_registry().
//
// A is n x n; of a symmetric pattern only the lower triangle is stored. Calls come in the order analyze(), factor(),
// solve(). A solver is used by one thread at a time; different solvers by different threads.
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

  // Factors new values, one for each entry of the pattern. Anything but `ok` leaves no factor. A solver that does not
  // check definiteness never returns not_positive_definite. Throws RunError when memory does not suffice.
  virtual FactorStatus factor(const double* values) = 0;

  // x = A^-1 b, both of size n; they may be the same. Precondition: the last factor() was ok.
  virtual void solve(const ConstVectorRef& b, VectorRef x) = 0;

  // How many eigenvalues of A are negative (Sylvester's law of inertia: of its pivots as many are), of the last factor
  // of a solver for indefinite matrices; 0 of others.
  virtual int negative_eigenvalues() const { return 0; }

  // Bytes taken at the peak of a factorisation: the factor and the solver's workspace. After analyze()
  // a prediction.
  virtual std::size_t factor_bytes() const = 0;

  // What was chosen at analysis, e.g. "supernodal, nested dissection".
  virtual std::string description() const = 0;
};

struct SolverKind {
  std::string sentence;
  bool takes_general;                                   // unsymmetric matrices too
  std::function<std::unique_ptr<LinearSolver>()> make;  // null for one that SUNDIALS has of its own
};

// For symmetric matrices that may be indefinite: factor() is `ok` for them. L D L^T without pivoting for size, which
// loses digits where a leading block of A is nearly singular.
std::unique_ptr<LinearSolver> make_indefinite_solver();

// By name. Written while the program and its plugins are loaded, only read afterwards.
std::map<std::string, SolverKind>& solver_registry();

}  // namespace orthodyn
