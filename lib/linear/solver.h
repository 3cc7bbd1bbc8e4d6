// Solvers for sparse linear systems A x = b with many matrices A on one pattern: direct solvers, and iterative solvers
// whose "factor" is a preconditioner. There is one kind of solver per file. The input chooses a kind by its name in
// solver_registry().
//
// A is n x n; of a symmetric pattern only the lower triangle is stored. Call analyze(), factor() and solve() in this
// order. A solver may be used by one thread at a time; different threads may use different solvers.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

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

  // Prepares for matrices on this pattern, which must outlive the solver. Throws RunError if memory does not suffice.
  virtual void analyze(const Pattern& pattern) = 0;

  // Factorises new values, one for each entry of the pattern. There is no factor unless `ok` is returned. The values
  // must stay unchanged as long as solve() is called. Throws RunError if memory does not suffice.
  virtual FactorStatus factor(const double* values) = 0;

  // True if factor() detects every indefinite symmetric A. Call it after analyze().
  virtual bool checks_definiteness() const = 0;

  // Solves A x = b. b and x have size n and may be the same vector. Precondition: the last factor() was ok. Iterative
  // solvers throw RecoverableError if they do not converge, or IndefiniteMatrix; x is then unchanged.
  virtual void solve(const ConstVectorRef& b, VectorRef x) = 0;

  // True if solutions are accurate to a tolerance, false if to round-off. Call it after analyze().
  virtual bool is_iterative() const { return false; }
  // Sets the tolerance of the next solutions of an iterative solver. A direct solver may then use single precision from
  // the next factor() on. Call it after analyze().
  virtual void set_tolerance(const SolveTolerance&) {}

  // True if rigid motions (n x 6, one in each column) would improve the next factor().
  virtual bool wants_rigid_motions() const { return false; }
  virtual void set_rigid_motions(const Eigen::MatrixXd&) {}

  // Number of negative eigenvalues of A at the last factor(), by Sylvester's law of inertia (the number of negative
  // pivots). 0 for solvers that accept only definite matrices.
  virtual int negative_eigenvalues() const { return 0; }

  // True if the determinant of an unsymmetric A at the last factor() is negative; empty if unknown. Complex eigenvalues
  // come in conjugate pairs, so a negative determinant means an odd number of negative eigenvalues.
  virtual std::optional<bool> has_negative_determinant() const { return std::nullopt; }

  // Peak memory of a factorisation in bytes, workspace included. Before the first factor() it is a prediction.
  virtual std::size_t factor_bytes() const = 0;

  // Choices made since analyze(), such as "supernodal, nested dissection".
  virtual std::string description() const = 0;
};

struct SolverKind {
  std::string sentence;
  bool takes_general;  // true if unsymmetric matrices are accepted, too
  // Makes the solver with the options of a SolverChoice. Null for solvers that SUNDIALS provides. Throws ConfigError
  // for unknown options.
  std::function<std::unique_ptr<LinearSolver>(const std::string& options)> make;
  bool takes_options = false;    // if false, options are refused
  std::string unavailable = {};  // why this build does not have the solver; "" if it does
  bool shares_the_work = false;  // works on matrices that are distributed over ranks
};

// Makes an L D L^T solver, analysed for this pattern, for symmetric matrices that may be indefinite; factor() returns
// `ok` for them. The solver does not pivot for size, so digits are lost if a leading block of A is nearly singular.
std::unique_ptr<LinearSolver> make_indefinite_solver(const Pattern& pattern);

// The kinds of solvers by name. The registry is filled while the program and its plugins are loaded, and is read-only
// afterwards.
std::map<std::string, SolverKind>& solver_registry();
inline bool register_solver(const std::string& name, SolverKind kind) {
  return solver_registry().emplace(name, std::move(kind)).second;
}

// Makes a solver. Precondition: the registry has a solver of that name, and it is not one of SUNDIALS. Throws
// ConfigError if this build does not have the solver, and for unknown options.
std::unique_ptr<LinearSolver> make_linear_solver(const SolverChoice& choice);

// As above; the solver is also analysed for this pattern, which may be distributed over ranks. A solver that cannot
// share the work runs on the first rank. Throws RunError if memory does not suffice.
std::unique_ptr<LinearSolver> make_linear_solver(const SolverChoice& choice, const Pattern& pattern);

// Makes a direct solver, analysed for this pattern. If the pattern is symmetric, the solver detects indefinite
// matrices. Throws RunError if memory does not suffice.
std::unique_ptr<LinearSolver> make_solver_for(const Pattern& pattern);

}  // namespace orthodyn
