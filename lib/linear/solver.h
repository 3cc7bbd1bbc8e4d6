// Solvers for sparse linear systems A x = b, of many matrices on one pattern: direct ones, and iterative ones whose
// "factor" is a preconditioner. One kind per file, chosen in the input by name through solver_registry().
//
// A is n x n; of a symmetric pattern only the lower triangle is stored. Calls come in the order analyze(), factor(),
// solve(). A solver is used by one thread at a time; different solvers by different threads.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "lib/core/errors.h"
#include "lib/core/pattern.h"
#include "lib/core/solver_choice.h"

namespace orthodyn {

enum class FactorStatus { ok, not_positive_definite, singular };

// Thrown by iterative solvers that find A indefinite.
class IndefiniteMatrix : public RecoverableError {
 public:
  using RecoverableError::RecoverableError;
};

// Relative error in the energy norm <= max(relative, absolute / rms(x)).
struct SolveTolerance {
  double relative = 1e-10, absolute = 0;
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  // Prepares for matrices on this pattern, which must outlive the solver. Throws RunError when
  // memory does not suffice.
  virtual void analyze(const Pattern& pattern) = 0;

  // Factorises new values, one for each entry of the pattern. Without `ok` there is no factor. Throws RunError if
  // memory does not suffice.
  virtual FactorStatus factor(const double* values) = 0;

  // Whether factor() finds every symmetric A that is indefinite. After analyze().
  virtual bool checks_definiteness() const = 0;

  // x = A^-1 b, both of size n; they may be the same. Precondition: the last factor() was ok. Iterative solvers throw
  // RecoverableError where they do not converge, and IndefiniteMatrix; x is then what it was.
  virtual void solve(const ConstVectorRef& b, VectorRef x) = 0;

  // True if solutions are accurate to a tolerance, false if to round-off. After analyze().
  virtual bool is_iterative() const { return false; }
  // Tolerance of the next solutions of an iterative solver. After analyze().
  virtual void set_tolerance(const SolveTolerance&) {}

  // Whether rigid motions (n x 6, one in each column) would improve the next factor().
  virtual bool wants_rigid_motions() const { return false; }
  virtual void set_rigid_motions(const Eigen::MatrixXd&) {}

  // Number of negative eigenvalues of A at the last factor(), by Sylvester's law of inertia (the number of negative
  // pivots). 0 for solvers of definite matrices.
  virtual int negative_eigenvalues() const { return 0; }

  // Sign of the determinant of A at the last factor() of a solver for unsymmetric matrices; none if the solver cannot
  // tell. Complex eigenvalues come in conjugate pairs, so a negative determinant means an odd number of negative
  // eigenvalues.
  virtual std::optional<bool> has_negative_determinant() const { return std::nullopt; }

  // Peak memory of a factorisation in bytes, workspace included. After analyze() a prediction.
  virtual std::size_t factor_bytes() const = 0;

  // Choices made since analyze(), such as "supernodal, nested dissection".
  virtual std::string description() const = 0;
};

struct SolverKind {
  std::string sentence;
  bool takes_general;  // also unsymmetric matrices
  // Makes the solver with the options of a SolverChoice. Null for solvers that SUNDIALS provides. Throws ConfigError
  // for unknown options.
  std::function<std::unique_ptr<LinearSolver>(const std::string& options)> make;
  bool takes_options = false;    // else options are refused
  std::string unavailable = {};  // why this build does not have the solver; "" if it has
  bool shares_the_work = false;  // works on matrices that are distributed over ranks
};

// An analysed L D L^T solver for symmetric matrices that may be indefinite: factor() is `ok` for them. There is no
// pivoting for size, so digits are lost where a leading block of A is nearly singular.
std::unique_ptr<LinearSolver> make_indefinite_solver(const Pattern& pattern);

// Solvers by name. Written while the program and its plugins are loaded, read-only afterwards.
std::map<std::string, SolverKind>& solver_registry();

// Precondition: the registry has a solver of that name, and it is not one of SUNDIALS. Throws ConfigError if this build
// does not have the solver, and for unknown options.
std::unique_ptr<LinearSolver> make_linear_solver(const SolverChoice& choice);

// The same, analysed for this pattern, which may be distributed over ranks. A solver that cannot share the work runs on
// the first rank. Throws RunError if memory does not suffice.
std::unique_ptr<LinearSolver> make_linear_solver(const SolverChoice& choice, const Pattern& pattern);

// A direct solver, analysed for this pattern; if the pattern is symmetric, the solver detects indefinite matrices.
// Throws RunError if memory does not suffice.
std::unique_ptr<LinearSolver> make_solver_for(const Pattern& pattern);

}  // namespace orthodyn
