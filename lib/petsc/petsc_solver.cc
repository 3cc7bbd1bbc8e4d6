// PETSc's conjugate gradients for matrices w_m M + w_d D + w_k K.
//
// Two preconditioners are used. If steps are short compared with the time a wave takes through an element, the mass
// dominates and the inverse 3x3 diagonal blocks suffice. For long steps multigrid is needed, with few but expensive
// iterations. The solver switches to multigrid according to the iterations per decimal digit of the residual. Matrices
// of a run are similar, so multigrid is set up for new values only if its convergence has degraded.
//
// Multigrid: Chebyshev smoother, coarsening by aggregation that keeps the body's rigid motions, unsmoothed prolongation
// (measurements in docs/decisions.md).
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "lib/core/errors.h"
#include "lib/linear/solver.h"
#include "lib/petsc/energy_test.h"
#include "lib/petsc/handle.h"
#include "lib/petsc/solver_matrix.h"

namespace orthodyn::petsc {
namespace {

constexpr const char* kMultigrid = "-pc_type gamg -pc_gamg_agg_nsmooths 0 ";
constexpr const char* kDiagonalBlocks = "-pc_type pbjacobi ";
constexpr const char* kKrylov = "-ksp_type cg ";

constexpr double kMaxPerDigit = 40;  // iterations per digit with diagonal blocks above which multigrid takes less time
constexpr int kMaxIterations = 500, kMaxWithBlocks = 200;
// Fewest unknowns per rank for multigrid on several ranks. GAMG of PETSc 3.18 does not terminate if a rank has nothing
// to coarsen, and such small systems need no multigrid.
constexpr int kFewestForMultigrid = 100;
// Multigrid is set up again above kDegraded * (iterations per digit after its set-up) + kMarginPerDigit.
constexpr double kDegraded = 1.5, kMarginPerDigit = 2;
constexpr double kFewestDigits = 0.5;  // solutions with fewer digits do not count for iterations per digit

class PetscSolver : public LinearSolver {
 public:
  explicit PetscSolver(std::string options) : scene_options_(std::move(options)) {
    const Session session;
    const Options read(environment_options() + scene_options_);
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
    allows_multigrid_ = !pattern.share || matrix_->fewest_unknowns() >= kFewestForMultigrid;
    uses_blocks_ = !has_own_preconditioner_;
    check(MatCreateVecs(matrix_->get(), x_.receive(), b_.receive()));
    make_method();
  }

  FactorStatus factor(const double* values) override {
    const Session session;
    if (!matrix_->set(*pattern_, values)) return FactorStatus::not_positive_definite;
    is_fresh_ = false;
    if (!is_set_up_ || !is_reusable() || is_degraded_) set_up();
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
    if (reason < 0 && uses_blocks_ && allows_multigrid_ && !shows_indefinite(reason)) {
      switch_to_multigrid();
      reason = solve_once();
      is_degraded_ = is_gamg_;  // to be set up again with rigid motions
    } else if (reason < 0 && !is_fresh_ && reason != KSP_DIVERGED_INDEFINITE_MAT) {
      set_up();
      reason = solve_once();
    }
    if (shows_indefinite(reason)) throw IndefiniteMatrix("the linear system is indefinite");
    if (reason < 0)
      throw RecoverableError(fmt::format("the linear solver does not converge (PETSc: {}, {} iterations)",
                                         KSPConvergedReasons[reason], last_iterations_));
    if (uses_blocks_ && allows_multigrid_ && per_digit_ > kMaxPerDigit) switches_to_multigrid_ = true;
    matrix_->gather(x_, x);
  }

  bool wants_rigid_motions() const override {
    return uses_blocks_ ? switches_to_multigrid_ : is_gamg_ && (!is_set_up_ || is_degraded_);
  }

  void set_rigid_motions(const Eigen::MatrixXd& motions) override {
    if (motions.cols() == 0) return;
    const Session session;
    matrix_->set_rigid_motions(motions);
  }

  // Multigrid operators of all levels take about as much as two matrices; plus vectors.
  std::size_t factor_bytes() const override {
    if (!matrix_) return 0;
    constexpr double kHierarchy = 2;
    return static_cast<std::size_t>((uses_blocks_ ? 1 : 1 + kHierarchy) * static_cast<double>(matrix_->bytes())) +
           8 * static_cast<std::size_t>(matrix_->rows()) * sizeof(double);
  }

  // The scene's options that no PETSc object has used.
  std::string unknown_options() const {
    const Session session;
    const Options own(scene_options_);
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

  static std::string environment_options() {
    const char* options = std::getenv("PETSC_OPTIONS");
    return options ? std::string(options) + " " : "";
  }

  // An indefinite preconditioner also implies an indefinite A: diagonal blocks are parts of A, and multigrid operators
  // derive from A.
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
    is_set_up_ = is_fresh_ = is_degraded_ = switches_to_multigrid_ = is_gamg_ = false;
  }

  // Creates the Krylov method and its preconditioner from the current options.
  void make_method() {
    options_ = std::make_unique<Options>(std::string(kKrylov) + (uses_blocks_ ? kDiagonalBlocks : kMultigrid) +
                                         environment_options() + scene_options_);
    const ActiveOptions active(*options_);
    check(KSPCreate(communicator(), method_.receive()));
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
    if (is_gamg_ && !allows_multigrid_)
      throw ConfigError(
          fmt::format("linear solver 'petsc' with options '{}': multigrid does not terminate if a rank has fewer than "
                      "{} unknowns; use fewer ranks, or no options",
                      scene_options_, kFewestForMultigrid));
  }

  MPI_Comm communicator() const { return pattern_->share ? PETSC_COMM_WORLD : PETSC_COMM_SELF; }

  double unknowns() const {
    return pattern_->share ? static_cast<double>(pattern_->share->unknowns) : static_cast<double>(pattern_->n);
  }

  void switch_to_multigrid() {
    uses_blocks_ = switches_to_multigrid_ = false;
    make_method();
    set_up();
  }

  // Factorisations and diagonal blocks are recomputed for each matrix.
  bool is_reusable() const {
    KSPType method = nullptr;
    check(KSPGetType(method_, &method));
    return !uses_blocks_ && std::string(method ? method : "") != KSPPREONLY;
  }

  bool has_own_tolerance() const { return options_->has("-ksp_rtol") || options_->has("-ksp_atol"); }
  PetscInt max_iterations() const {
    if (options_->has("-ksp_max_it")) return PETSC_DEFAULT;
    return uses_blocks_ && allows_multigrid_ ? kMaxWithBlocks : kMaxIterations;
  }

  void set_up() {
    if (switches_to_multigrid_) return switch_to_multigrid();
    if (is_gamg_ && is_set_up_) make_method();  // GAMG would keep the rigid motions of its first set-up
    const ActiveOptions active(*options_);
    check(KSPSetReusePreconditioner(method_, PETSC_FALSE));
    check(KSPSetOperators(method_, matrix_->get(), matrix_->get()));
    check(KSPSetUp(method_));
    check(KSPSetReusePreconditioner(method_, PETSC_TRUE));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(method_, &reason));
    is_set_up_ = !any_rank(communicator(), reason == KSP_DIVERGED_PC_FAILED);  // each rank knows only its own part
    is_fresh_ = true;
    is_degraded_ = false;
    fresh_per_digit_ = 0;
    ++set_ups_;
  }

  KSPConvergedReason solve_once() {
    if (!has_own_tolerance())
      check(KSPSetTolerances(method_, tolerance_.relative, PETSC_DEFAULT, PETSC_DEFAULT, max_iterations()));
    const ActiveOptions active(*options_);
    check(KSPSolve(method_, b_, x_));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(method_, &reason));
    record_iterations(reason);
    return reason;
  }

  // Updates the iterations per digit, and whether multigrid has degraded since its set-up.
  void record_iterations(KSPConvergedReason reason) {
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
    if (per_digit_ > kDegraded * fresh_per_digit_ + kMarginPerDigit) is_degraded_ = true;
  }

  std::string scene_options_;
  bool has_own_preconditioner_;
  const Pattern* pattern_ = nullptr;
  SolveTolerance tolerance_;
  EnergyTest test_;
  std::unique_ptr<SolverMatrix> matrix_;
  std::unique_ptr<Options> options_;
  OwnedMethod method_;
  OwnedVector x_, b_;
  bool allows_multigrid_ = true;
  bool uses_blocks_ = false;
  bool is_gamg_ = false;
  bool is_set_up_ = false;
  bool is_fresh_ = false;               // set up for the current values
  bool is_degraded_ = false;            // converges more slowly than after its set-up
  bool switches_to_multigrid_ = false;  // switches with the next values
  double per_digit_ = 0, fresh_per_digit_ = 0;
  int last_iterations_ = 0;
  long iterations_ = 0, solutions_ = 0, set_ups_ = 0;
};

// Tries options on a chain of three springs in each direction, so that wrong options are reported before a run.
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
    throw ConfigError("linear solver 'petsc': options unknown to this PETSc or without effect: " + unknown +
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
