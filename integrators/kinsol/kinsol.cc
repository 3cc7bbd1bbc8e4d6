// KINSOL's Newton iteration (Hindmarsh et al. 2005) for -f(t, q, 0) = 0, with the stiffness K factored each time.
//
// Nearby: full steps, which must contract, |dq_1| <= |dq_0|/2 and |dq_k+1| <= |dq_k|, else a solution is not one
// that the guess leads to (Deuflhard, Newton Methods for Nonlinear Problems, 2004, 3.3 and 5.2), and K must be
// positive definite. That the residual falls is not asked for: in thin bodies that bend it rises first, by the
// stretching that a straight step brings. With line_search it is (Dennis & Schnabel 1983, A6.3.1), in place of
// contraction.
// Anywhere: with the positive semidefinite part of K, whose corrections lead down the energy, each at most as long as
// the motion's size. The residual, which rises beyond a limit point, is not looked at either.
//
// Round-off of large internal forces may keep the residual from falling below the tolerance; a solution then is
// where Newton's next correction is below the tolerance of the motion, or round-off itself, and the attempt says so.
//
// With an approximate K corrections may fail to contract anywhere: that says nothing on the branch.
#include <fmt/format.h>
#include <kinsol/kinsol.h>
#include <kinsol/kinsol_ls.h>

#include <algorithm>
#include <cmath>

#include "integrators/newton_matrix.h"
#include "integrators/solver_options.h"
#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/solver_adapter.h"
#include "lib/ode/equilibrium.h"
#include "lib/ode/integrator.h"

namespace orthodyn::sundials {
namespace {

struct KinsolOptions {
  double rtol = 1e-8;
  bool line_search = false;
  long max_iterations = 50;
  std::string linear_solver = "cholmod";
};

struct FreeKinsol {
  void operator()(void* memory) const { KINFree(&memory); }
};

constexpr double kRoundOff = 1e-11;  // of the motion

class Kinsol : public EquilibriumSolver {
 public:
  Kinsol(const Model& model, const EquilibriumTask& task, const KinsolOptions& options)
      : model_(model), task_(task), options_(options), still_(Vector::Zero(model.num_dofs())),
        matrix_(make_matrix()), q_(make_vector(model.num_dofs(), context_)),
        position_weights_(make_vector(model.num_dofs(), context_)),
        force_weights_(make_vector(model.num_dofs(), context_)), memory_(KINCreate(context_)) {
    if (!memory_) throw RunError("KINSOL could not be created");
    view(position_weights_.get()).setConstant(1 / task.length);
    view(force_weights_.get()).setConstant(1 / task.force);
    initialise();
  }

  Attempt solve(double t, Vector& q, Where where) override {
    t_ = t;
    where_ = where;
    callback_context_ = {};
    renew_matrix(where == Where::nearby ? TangentKind::exact : TangentKind::gauss_newton);
    indefinite_ = false;
    corrections_.clear();
    view(q_.get()) = q;
    constexpr double kUnlimited = 1e12;  // of the motion's size
    const double longest = where == Where::nearby ? kUnlimited : std::sqrt(static_cast<double>(model_.num_dofs()));
    require(KINSetMaxNewtonStep(memory_.get(), longest));
    const int flag = KINSol(memory_.get(), q_.get(), searches_line() ? KIN_LINESEARCH : KIN_NONE,
                            position_weights_.get(), force_weights_.get());
    if (callback_context_.failure) std::rethrow_exception(callback_context_.failure);
    Attempt attempt;
    KINGetNumNonlinSolvIters(memory_.get(), &attempt.iterations);
    statistics_.newton_iterations += attempt.iterations;
    const bool diverged = flag == KIN_LINSOLV_NO_RECOVERY && callback_context_.recoverable_cause.empty();
    attempt.indefinite = indefinite_ || (diverged && model_.traits().exact_stiffness);
    const bool within_tolerance = flag == KIN_SUCCESS || flag == KIN_INITIAL_GUESS_OK;
    attempt.found = within_tolerance || (!indefinite_ && is_settled());
    if (attempt.found) {
      q = view(q_.get());
      attempt.residual = residual();
      attempt.above_tolerance = !within_tolerance;
    } else {
      attempt.failure_reason = sentence(flag);
    }
    return attempt;
  }

  const Statistics& statistics() const override { return statistics_; }
  std::size_t factor_bytes() const override { return matrix_->factor_bytes(); }
  std::string description() const override { return options_.linear_solver + " (" + matrix_->description() + ")"; }

 private:
  bool searches_line() const { return options_.line_search && where_ == Where::nearby; }

  std::unique_ptr<NewtonMatrix> make_matrix() {
    return std::make_unique<NewtonMatrix>(model_, options_.linear_solver, tangent_, statistics_);
  }

  // One that has met an indefinite matrix would go on with the Gauss-Newton part for a while.
  void renew_matrix(TangentKind tangent) {
    if (tangent == tangent_ && statistics_.gauss_newton_fallbacks == fallbacks_) return;
    tangent_ = tangent;
    fallbacks_ = statistics_.gauss_newton_fallbacks;
    matrix_ = make_matrix();
  }

  void initialise() {
    void* m = memory_.get();
    ORTHODYN_CAPTURE_ERRORS(KINSetErrHandlerFn, context_, m, &callback_context_.message);
    require(KINInit(m, [](N_Vector q, N_Vector f, void* user) { return self(user).evaluate(q, f); }, q_.get()));
    require(KINSetUserData(m, this));
    functions_.setup = [this] { return factor(); };
    functions_.solve = [this](N_Vector dq, N_Vector b) {
      bool good = false;
      const int thrown = guarded(callback_context_, [&] {
        matrix_->solve(view(b), view(dq));
        good = contracts(view(dq).lpNorm<Eigen::Infinity>());
      });
      return thrown ? thrown : good ? 0 : 1;
    };
    plug_ = make_placeholder_matrix(context_);
    solver_ = make_solver_adapter(functions_, context_);
    require(KINSetLinearSolver(m, solver_.get(), plug_.get()));
    require(KINSetJacFn(m, [](N_Vector q, N_Vector, SUNMatrix, void* user, N_Vector, N_Vector) {
      return self(user).linearize(q);
    }));
    require(KINSetMaxSetupCalls(m, 1));
    require(KINSetNumMaxIters(m, options_.max_iterations));
    require(KINSetFuncNormTol(m, options_.rtol));
    require(KINSetScaledStepTol(m, 1e-3 * options_.rtol));
  }

  static Kinsol& self(void* user) { return *static_cast<Kinsol*>(user); }

  void require(int flag) const {
    if (flag < 0) throw RunError("kinsol refused its set-up: " + callback_context_.message);
  }

  int evaluate(N_Vector q, N_Vector minus_f) {
    return guarded(callback_context_, [&] {
      const Measure measure(statistics_.force);
      auto out = view(minus_f);
      model_.force(t_, view(q), still_, out);
      require_finite(out);
      out = -out;
    });
  }

  int linearize(N_Vector q) {
    return guarded(callback_context_, [&] { matrix_->linearize(t_, view(q), still_); });
  }

  bool contracts(double correction) {
    corrections_.push_back(correction);
    const auto k = corrections_.size() - 1;
    if (where_ == Where::anywhere || searches_line() || k == 0) return std::isfinite(correction);
    return correction <= (k == 1 ? 0.5 : 1.0) * corrections_[k - 1];
  }

  int factor() {
    bool factored = false;
    const long before = statistics_.gauss_newton_fallbacks;
    const int thrown = guarded(callback_context_, [&] { factored = matrix_->factor({0, 0, 1}); });
    if (thrown) return thrown;
    if (!factored || (where_ == Where::nearby && statistics_.gauss_newton_fallbacks > before)) indefinite_ = true;
    return indefinite_ ? 1 : 0;
  }

  double residual() {
    Vector f(model_.num_dofs());
    model_.force(t_, view(q_.get()), still_, f);
    return f.lpNorm<Eigen::Infinity>();
  }

  // Whether one more Newton step would change next to nothing. One by an approximate K may be short far from there.
  bool is_settled() {
    try {
      Vector f(model_.num_dofs()), correction(f.size());
      model_.force(t_, view(q_.get()), still_, f);
      matrix_->linearize(t_, view(q_.get()), still_);
      if (factor() != 0) return false;
      matrix_->solve(f, correction);
      const double motion = std::max(view(q_.get()).lpNorm<Eigen::Infinity>(), 1e-3 * task_.length);
      return correction.lpNorm<Eigen::Infinity>() <=
             std::max(model_.traits().exact_stiffness ? options_.rtol : 0, kRoundOff) * motion;
    } catch (const RecoverableError&) {
      return false;
    }
  }

  std::string sentence(int flag) const {
    const std::string cause =
        callback_context_.recoverable_cause.empty() ? "" : " (" + callback_context_.recoverable_cause + ")";
    switch (flag) {
      case KIN_MAXITER_REACHED:
        return fmt::format("Newton's method did not converge within {} iterations (statics.solver.max_iterations)",
                           options_.max_iterations);
      case KIN_LINSOLV_NO_RECOVERY:
        return (model_.traits().exact_stiffness
                    ? "Newton's corrections do not contract"
                    : "Newton's corrections do not contract, by a stiffness that is approximate: take "
                      "elasticity.warped_tangent: unsymmetric and statics.solver.linear_solver: klu") +
               cause;
      case KIN_LSETUP_FAIL: return "the stiffness is not positive definite";
      case KIN_FIRST_SYSFUNC_ERR:
      case KIN_SYSFUNC_FAIL:
      case KIN_REPTD_SYSFUNC_ERR: return "the forces could not be evaluated" + cause;
      case KIN_LINESEARCH_NONCONV:
      case KIN_LINESEARCH_BCFAIL: return "the residual does not fall along Newton's direction" + cause;
      case KIN_STEP_LT_STPTOL:
        return "Newton's corrections have become too small for the residual that is left" + cause;
      default:
        return "KINSOL says: " + callback_context_.message;
    }
  }

  const Model& model_;
  EquilibriumTask task_;
  KinsolOptions options_;
  Statistics statistics_;
  Vector still_;  // velocities
  double t_ = 0;
  Where where_ = Where::nearby;
  bool indefinite_ = false;
  std::vector<double> corrections_;  // the largest of each iteration
  CallbackContext callback_context_;
  TangentKind tangent_ = TangentKind::exact;
  std::unique_ptr<NewtonMatrix> matrix_;
  long fallbacks_ = 0;  // when the matrix was made
  SolverFunctions functions_;
  Context context_;
  OwnedVector q_, position_weights_, force_weights_;
  OwnedMatrix plug_;
  OwnedSolver solver_;
  std::unique_ptr<void, FreeKinsol> memory_;
};

class KinsolChoice : public EquilibriumChoice, public KinsolOptions {
 public:
  static const Spec<KinsolChoice>& spec() {
    using C = KinsolChoice;
    static const auto s = [] {
      auto spec =
          Spec<C>()
              .key("rtol", &C::rtol, "Largest residual, relative to the largest load on a coordinate.",
                   {.range = {1e-15, 1e-2}})
              .key("line_search", &C::line_search,
                   "Shorten steps until the residual falls, in place of the test that corrections contract.")
              .key("max_iterations", &C::max_iterations, "Newton iterations per load step.", {.range = {1, 10'000}});
      add_linear_solver(spec, SolverPaths::reduced);
      return spec;
    }();
    return s;
  }
  static MethodFacts facts() {
    return {{"source", "Hindmarsh et al., ACM TOMS 31, 2005; Deuflhard, Newton Methods for Nonlinear Problems, 2004"}};
  }
  std::unique_ptr<EquilibriumSolver> make(const Model& model, const EquilibriumTask& task) const override {
    return std::make_unique<Kinsol>(model, task, *this);
  }
};

const bool kinsol_registered = Registry<EquilibriumChoice>::add<KinsolChoice>(
    "kinsol", "KINSOL: Newton's method, K factored anew each time; down the energy where a branch was lost.");

}  // namespace
}  // namespace orthodyn::sundials
