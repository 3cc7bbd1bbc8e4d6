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

// A turned out to be indefinite on the way to a solution.
class IndefiniteMatrix : public RecoverableError {
 public:
  using RecoverableError::RecoverableError;
};

// How good a solution has to be: its error, relative to the solution in the norm of A, at most the larger one of
// `relative` and the share that `absolute` is of the root mean square of x.
struct SolveTolerance {
  double relative = 1e-10, absolute = 0;
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  // Prepares for matrices on this pattern, which must outlive the solver. Throws RunError when
  // memory does not suffice.
  virtual void analyze(const Pattern& pattern) = 0;

  // Factors new values, one for each entry of the pattern. Anything but `ok` leaves no factor. Throws RunError when
  // memory does not suffice.
  virtual FactorStatus factor(const double* values) = 0;

  // Whether factor() finds every symmetric A that is indefinite. After analyze().
  virtual bool checks_definiteness() const = 0;

  // x = A^-1 b, both of size n; they may be the same. Precondition: the last factor() was ok. Iterative solvers throw
  // RecoverableError where they do not converge, and IndefiniteMatrix; x is then what it was.
  virtual void solve(const ConstVectorRef& b, VectorRef x) = 0;

  // Whether solutions are as good as their tolerance, and not to round-off. After analyze().
  virtual bool is_iterative() const { return false; }
  // Of the next solutions of an iterative solver. After analyze().
  virtual void set_tolerance(const SolveTolerance&) {}

  // Whether the next factor() would be better for the motions that A resists least, in the columns of n x 6.
  virtual bool wants_rigid_motions() const { return false; }
  virtual void set_rigid_motions(const Eigen::MatrixXd&) {}

  // How many eigenvalues of A are negative (Sylvester's law of inertia: of its pivots as many are), of the last factor
  // of a solver for indefinite matrices; 0 of others.
  virtual int negative_eigenvalues() const { return 0; }

  // Of the last factor of a solver for unsymmetric matrices; none where it does not tell. As eigenvalues come in conjugate
  // pairs, an odd number of them is negative where the determinant is.
  virtual std::optional<bool> has_negative_determinant() const { return std::nullopt; }

  // Bytes taken at the peak of a factorisation: the factor and the solver's workspace. After analyze()
  // a prediction.
  virtual std::size_t factor_bytes() const = 0;

  // What was chosen at analysis and since, e.g. "supernodal, nested dissection".
  virtual std::string description() const = 0;
};

struct SolverKind {
  std::string sentence;
  bool takes_general;  // unsymmetric matrices too
  // With the options of a SolverChoice. Null for one that SUNDIALS has of its own. Throws ConfigError for options that
  // the solver does not know.
  std::function<std::unique_ptr<LinearSolver>(const std::string& options)> make;
  bool takes_options = false;    // others refuse them
  std::string unavailable = {};  // why this build cannot make it
  bool shares_the_work = false;  // takes the parts of matrices that several ranks have
};

// For symmetric matrices on this pattern that may be indefinite, analysed: factor() is `ok` for them. L D L^T without
// pivoting for size, which loses digits where a leading block of A is nearly singular.
std::unique_ptr<LinearSolver> make_indefinite_solver(const Pattern& pattern);

// By name. Written while the program and its plugins are loaded, only read afterwards.
std::map<std::string, SolverKind>& solver_registry();

// Precondition: a solver of that name is in the registry, and SUNDIALS is not the one that has it. Throws ConfigError
// if this build cannot make it, or for its options.
std::unique_ptr<LinearSolver> make_linear_solver(const SolverChoice& choice);

// The same, analysed, for matrices on this pattern, also where several ranks have parts of them; by the first of these
// alone if the solver cannot share the work. Throws RunError when memory does not suffice.
std::unique_ptr<LinearSolver> make_linear_solver(const SolverChoice& choice, const Pattern& pattern);

// A direct solver for matrices on this pattern, analysed: one that finds indefinite ones where it is symmetric. Throws
// RunError when memory does not suffice.
std::unique_ptr<LinearSolver> make_solver_for(const Pattern& pattern);

}  // namespace orthodyn
