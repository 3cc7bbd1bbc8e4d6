// Conjugate gradients for matrices w_m M + w_d D + w_k K, by PETSc.
//
// Two preconditioners suit these. Where steps are short against the waves through an element the mass rules, and the
// inverses of the diagonal's 3x3 blocks are enough; where they are long multigrid is needed, whose iterations are few
// and dear. Which of them takes less is seen from the iterations for each digit. Multigrid is set up when there are new
// values only once it has become worse than it was: the matrices of a run are alike.
//
// Multigrid is smoothed by Chebyshev's polynomials and coarsened by aggregates that keep the body's rigid motions. Its
// prolongations are not smoothed: figures in docs/decisions.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "lib/core/errors.h"
#include "lib/linear/petsc_library.h"
#include "lib/linear/solver.h"
#include "lib/petsc/allowed_options.h"
#include "lib/petsc/energy_test.h"
#include "lib/petsc/handle.h"
#include "lib/petsc/solver_matrix.h"

namespace orthodyn::petsc {
namespace {

constexpr const char* kMultigrid = "-pc_type gamg -pc_gamg_agg_nsmooths 0 ";
constexpr const char* kDiagonalBlocks = "-pc_type pbjacobi ";
constexpr const char* kKrylov = "-ksp_type cg ";

constexpr double kMostPerDigit = 40;  // iterations with diagonal blocks, from which multigrid takes less
constexpr int kMostIterations = 500, kMostWithBlocks = 200;
// Unknowns of each of several ranks: GAMG of PETSc 3.18 does not end where one has nothing to coarsen, and so small
// systems need no multigrid.
constexpr int kFewestForMultigrid = 100;
constexpr double kWorse = 1.5, kFewMore = 2;  // of multigrid: times and iterations a digit, until it is set up anew
constexpr double kFewestDigits = 0.5;         // below which a solution says nothing

class PetscSolver : public LinearSolver {
 public:
  explicit PetscSolver(std::string options) : given_(std::move(options)) {
    const Session session;
    const Options read(everywhere() + given_);
    has_own_preconditioner_ = read.has("-pc_type") || read.has("-ksp_type");
  }

  ~PetscSolver() override {
    const Session session;
    release();
  }

  void analyze(const Pattern& pattern) override {
    const Session session;
    release();
    pattern_ = &pattern;
    matrix_ = SolverMatrix::of(pattern);
    takes_multigrid_ = !pattern.share || matrix_->fewest_unknowns() >= kFewestForMultigrid;
    with_blocks_ = !has_own_preconditioner_;
    check(MatCreateVecs(matrix_->get(), x_.receive(), b_.receive()));
    make_method();
  }

  FactorStatus factor(const double* values) override {
    const Session session;
    if (!matrix_->set(*pattern_, values)) return FactorStatus::not_positive_definite;
    is_new_ = false;
    if (!is_set_up_ || !is_reusable() || is_worse_) set_up();
    return is_set_up_ ? FactorStatus::ok : FactorStatus::singular;
  }

  bool checks_definiteness() const override { return false; }

  bool is_iterative() const override { return true; }
  void set_tolerance(const SolveTolerance& tolerance) override {
    tolerance_ = tolerance;
    test_.set(tolerance_, unknowns());
  }

  void solve(const ConstVectorRef& b, VectorRef x) override {
    const Session session;
    matrix_->scatter(b, b_);
    KSPConvergedReason reason = solve_once();
    if (reason < 0 && with_blocks_ && takes_multigrid_ && !shows_indefinite(reason)) {
      take_multigrid();
      reason = solve_once();
      is_worse_ = is_gamg_;  // than with rigid motions
    } else if (reason < 0 && !is_new_ && reason != KSP_DIVERGED_INDEFINITE_MAT) {
      set_up();
      reason = solve_once();
    }
    if (shows_indefinite(reason)) throw IndefiniteMatrix("the linear system is indefinite");
    if (reason < 0)
      throw RecoverableError(fmt::format("the linear solver does not converge ({} of PETSc, in {} iterations)",
                                         KSPConvergedReasons[reason], last_iterations_));
    if (with_blocks_ && takes_multigrid_ && per_digit_ > kMostPerDigit) is_to_change_ = true;
    matrix_->gather(x_, x);
  }

  // For a set-up.
  bool wants_rigid_motions() const override {
    return with_blocks_ ? is_to_change_ : is_gamg_ && (!is_set_up_ || is_worse_);
  }

  void set_rigid_motions(const Eigen::MatrixXd& motions) override {
    if (motions.cols() == 0) return;
    const Session session;
    matrix_->set_rigid_motions(motions);
  }

  // Multigrid has operators on all levels, which measure about as much as two matrices, and vectors.
  std::size_t factor_bytes() const override {
    if (!matrix_) return 0;
    constexpr double kHierarchy = 2;
    return static_cast<std::size_t>((with_blocks_ ? 1 : 1 + kHierarchy) * static_cast<double>(matrix_->bytes())) +
           8 * static_cast<std::size_t>(matrix_->rows()) * sizeof(double);
  }

  // Of the solver's own, which nothing has asked for.
  std::string unknown_options() const {
    const Session session;
    const Options own(given_);
    std::string all;
    for (const std::string& name : options_->unused())
      if (own.has(("-" + name).c_str())) all += (all.empty() ? "-" : ", -") + name;
    return all;
  }

  std::string description() const override {
    const Session session;
    KSPType method = nullptr;
    PC preconditioner = nullptr;
    PCType kind = nullptr;
    if (method_.get()) {
      check(KSPGetType(method_, &method));
      check(KSPGetPC(method_, &preconditioner));
      check(PCGetType(preconditioner, &kind));
    }
    std::string text = fmt::format("{}, {}", method ? method : "cg", readable(kind));
    if (solutions_ > 0)
      text += fmt::format(", {:.3g} iterations a solution, set up {} times",
                          static_cast<double>(iterations_) / static_cast<double>(solutions_), set_ups_);
    return text;
  }

 private:
  static std::string readable(PCType kind) {
    const std::string name = kind ? kind : "";
    if (name == PCGAMG) return "algebraic multigrid";
    if (name == PCPBJACOBI) return "diagonal blocks";
    return name;
  }

  static std::string everywhere() {
    const char* options = std::getenv("PETSC_OPTIONS");
    return options ? std::string(options) + " " : "";
  }

  // The diagonal's blocks are indefinite where A is; multigrid may be so because of it.
  static bool shows_indefinite(KSPConvergedReason reason) {
    return reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC;
  }

  void release() {
    method_.reset();
    x_.reset();
    b_.reset();
    matrix_.reset();
    options_.reset();
    per_digit_ = fresh_per_digit_ = 0;
    iterations_ = solutions_ = set_ups_ = 0;
    is_set_up_ = is_new_ = is_worse_ = is_to_change_ = is_gamg_ = false;
  }

  // The method and its preconditioner, from the options in force.
  void make_method() {
    options_ = std::make_unique<Options>(std::string(kKrylov) + (with_blocks_ ? kDiagonalBlocks : kMultigrid) +
                                         everywhere() + given_);
    const InUse in_use(*options_);
    check(KSPCreate(ranks(), method_.receive()));
    check(KSPSetOperators(method_, matrix_->get(), matrix_->get()));
    check(KSPSetFromOptions(method_));
    check(KSPSetResidualHistory(method_, nullptr, PETSC_DECIDE, PETSC_TRUE));
    test_.set(tolerance_, unknowns());
    if (!has_own_tolerance()) test_.attach(method_);
    PC preconditioner = nullptr;
    PCType kind = nullptr;
    check(KSPGetPC(method_, &preconditioner));
    check(PCGetType(preconditioner, &kind));
    is_gamg_ = kind && std::string(kind) == PCGAMG;
    is_set_up_ = false;
    if (is_gamg_ && !takes_multigrid_)
      throw ConfigError(
          fmt::format("linear solver 'petsc' with options '{}': multigrid does not end where a rank has "
                      "less than {} unknowns; use fewer ranks, or no options",
                      given_, kFewestForMultigrid));
  }

  MPI_Comm ranks() const { return pattern_->share ? PETSC_COMM_WORLD : PETSC_COMM_SELF; }

  double unknowns() const {
    return pattern_->share ? static_cast<double>(pattern_->share->unknowns) : static_cast<double>(pattern_->n);
  }

  void take_multigrid() {
    with_blocks_ = is_to_change_ = false;
    make_method();
    set_up();
  }

  // A factorisation is of one matrix, as are the diagonal's blocks, which cost nothing.
  bool is_reusable() const {
    KSPType method = nullptr;
    check(KSPGetType(method_, &method));
    return !with_blocks_ && std::string(method ? method : "") != KSPPREONLY;
  }

  bool has_own_tolerance() const { return options_->has("-ksp_rtol") || options_->has("-ksp_atol"); }
  PetscInt most() const {
    if (options_->has("-ksp_max_it")) return PETSC_DEFAULT;
    return with_blocks_ && takes_multigrid_ ? kMostWithBlocks : kMostIterations;
  }

  void set_up() {
    if (is_to_change_) return take_multigrid();
    if (is_gamg_ && is_set_up_) make_method();  // it would keep the rigid motions of its first set-up
    const InUse in_use(*options_);
    check(KSPSetReusePreconditioner(method_, PETSC_FALSE));
    check(KSPSetOperators(method_, matrix_->get(), matrix_->get()));
    check(KSPSetUp(method_));
    check(KSPSetReusePreconditioner(method_, PETSC_TRUE));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(method_, &reason));
    is_set_up_ = !on_any(ranks(), reason == KSP_DIVERGED_PC_FAILED);  // which a rank knows of its own part
    is_new_ = true;
    is_worse_ = false;
    fresh_per_digit_ = 0;
    ++set_ups_;
  }

  KSPConvergedReason solve_once() {
    if (!has_own_tolerance())
      check(KSPSetTolerances(method_, tolerance_.relative, PETSC_DEFAULT, PETSC_DEFAULT, most()));
    const InUse in_use(*options_);
    check(KSPSolve(method_, b_, x_));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(method_, &reason));
    learn(reason);
    return reason;
  }

  // How many iterations a digit takes, and whether multigrid has become worse than when it was set up.
  void learn(KSPConvergedReason reason) {
    PetscInt count = 0;
    check(KSPGetIterationNumber(method_, &count));
    last_iterations_ = static_cast<int>(count);
    iterations_ += last_iterations_;
    ++solutions_;
    const PetscReal* sizes = nullptr;
    PetscInt length = 0;
    check(KSPGetResidualHistory(method_, &sizes, &length));
    if (reason < 0 || length < 2 || !(sizes[length - 1] > 0)) return;
    const double digits = std::log10(sizes[0] / sizes[length - 1]);
    if (digits < kFewestDigits) return;
    per_digit_ = last_iterations_ / digits;
    if (fresh_per_digit_ == 0) fresh_per_digit_ = per_digit_;
    if (per_digit_ > kWorse * fresh_per_digit_ + kFewMore) is_worse_ = true;
  }

  std::string given_;
  bool has_own_preconditioner_;
  const Pattern* pattern_ = nullptr;
  SolveTolerance tolerance_;
  EnergyTest test_;
  std::unique_ptr<SolverMatrix> matrix_;
  std::unique_ptr<Options> options_;
  OwnedMethod method_;
  OwnedVector x_, b_;
  bool takes_multigrid_ = true;
  bool with_blocks_ = false;
  bool is_gamg_ = false;
  bool is_set_up_ = false;
  bool is_new_ = false;        // set up for these very values
  bool is_worse_ = false;      // than when it was set up
  bool is_to_change_ = false;  // to multigrid, with the next values
  double per_digit_ = 0, fresh_per_digit_ = 0;
  int last_iterations_ = 0;
  long iterations_ = 0, solutions_ = 0, set_ups_ = 0;
};

// Options are tried on three springs in each direction, so that a wrong one is told before a run.
void try_options(const std::string& options) {
  constexpr int kPoints = 4;
  Pattern pattern;
  std::vector<double> values;
  pattern.n = 3 * kPoints;
  pattern.column_start.push_back(0);
  for (int i = 0; i < pattern.n; ++i) {
    pattern.coordinate.push_back(i);
    for (const int j : {i, i + 3})
      if (j < pattern.n) {
        pattern.row.push_back(j);
        values.push_back(j == i ? 2.5 : -1);
      }
    pattern.column_start.push_back(pattern.non_zeros());
  }
  PetscSolver solver(options);
  Vector x = Vector::Ones(pattern.n);
  try {
    solver.analyze(pattern);
    if (solver.wants_rigid_motions()) solver.set_rigid_motions(Eigen::MatrixXd::Identity(pattern.n, 3));
    solver.factor(values.data());
    solver.solve(x, x);
  } catch (const RunError& e) {
    throw ConfigError("linear solver 'petsc' with options '" + options + "': " + e.what());
  } catch (const RecoverableError& e) {
    throw ConfigError("linear solver 'petsc' with options '" + options + "' fails on a matrix of " +
                      std::to_string(pattern.n) + " unknowns: " + e.what());
  }
  if (const std::string unknown = solver.unknown_options(); !unknown.empty())
    throw ConfigError("linear solver 'petsc': unknown to this PETSc, or without effect here: " + unknown +
                      "; see the manual pages of KSPSetFromOptions and PCSetFromOptions");
}

}  // namespace
}  // namespace orthodyn::petsc

extern "C" [[gnu::visibility("default")]] orthodyn::LinearSolver* orthodyn_make_petsc_solver(
    const std::string& options) {
  orthodyn::petsc::require_allowed(options);
  if (!options.empty()) orthodyn::petsc::try_options(options);
  return new orthodyn::petsc::PetscSolver(options);
}
