#include "integrators/kinsol/kinsol.h"

#include <fmt/format.h>
#include <kinsol/kinsol.h>
#include <kinsol/kinsol_ls.h>

#include <algorithm>
#include <cmath>

#include "integrators/kinsol/path_stiffness.h"
#include "integrators/random_vector.h"
#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/solver_adapter.h"

namespace orthodyn::sundials {
namespace {

struct FreeKinsol {
  void operator()(void* memory) const { KINFree(&memory); }
};

constexpr double kSolutionRoundOff = 1e-11;  // round-off of a solution, relative to the motion

Vector unit_random_vector(const Model& model) {
  const Vector b = random_vector(model);
  return b / model.space().norm(b);
}

// Explains a flag of KINSol(), with the key that may help.
std::string failure_message(int flag, const KinsolOptions& options, bool stiffness_is_exact,
                            const CallbackContext& context) {
  const std::string cause = context.recoverable_cause.in_brackets();
  const std::string approximate = stiffness_is_exact ? ""
                                                     : "; the stiffness is approximate: set elasticity.warped_tangent: "
                                                       "unsymmetric and statics.solver.linear_solver: klu";
  switch (flag) {
    case KIN_MAXITER_REACHED:
      return fmt::format("Newton's method did not converge within {} iterations (statics.solver.max_iterations){}",
                         options.max_iterations, approximate);
    case KIN_LINSOLV_NO_RECOVERY: return "Newton's corrections do not contract" + approximate + cause;
    case KIN_LSETUP_FAIL: return "the stiffness is singular";
    case KIN_FIRST_SYSFUNC_ERR:
    case KIN_SYSFUNC_FAIL:
    case KIN_REPTD_SYSFUNC_ERR: return context.recoverable_cause.explain("the forces could not be evaluated", "");
    case KIN_STEP_LT_STPTOL: return "Newton's corrections have become too small to reduce the residual" + cause;
    default: return "KINSOL says: " + context.message;
  }
}

class Kinsol : public EquilibriumSolver {
 public:
  Kinsol(const LoadPath& path, const EquilibriumTask& task, const KinsolOptions& options)
      : path_(path),
        space_(path.space()),
        n_(path.num_dofs()),
        task_(task),
        options_(options),
        zero_velocity_(Vector::Zero(n_)),
        stiffness_(path, options.linear_solver, statistics_),
        probe_(unit_random_vector(path)),
        unknowns_(make_vector(path.num_dofs() + 1, context_, path.ranks())),
        position_weights_(make_vector(path.num_dofs() + 1, context_, path.ranks())),
        force_weights_(make_vector(path.num_dofs() + 1, context_, path.ranks())),
        memory_(KINCreate(context_)) {
    if (!memory_) throw RunError("KINSOL could not be created");
    view(position_weights_.get()).setConstant(1 / task.length);
    view(force_weights_.get()).setConstant(1 / task.force);
    view(position_weights_.get())[n_] = view(force_weights_.get())[n_] = 1;
    initialise();
  }

  Attempt solve(const PathPoint& before, PathPoint& point, const PathPlane& plane) override {
    before_ = before;
    plane_ = &plane;
    descends_ = false;
    constexpr double kUnlimited = 1e12;  // relative to the motion
    return run(point, kUnlimited);
  }

  Attempt descend(PathPoint& point) override {
    const PathPlane fixed_load;
    plane_ = &fixed_load;
    descends_ = true;
    return run(point, std::sqrt(static_cast<double>(path_.num_dofs_of_all())));
  }

  std::optional<Response> respond(const PathPoint& at) override {
    try {
      stiffness_.linearize(at.lambda, at.q, TangentKind::exact);
      if (!stiffness_.factor_with_inertia()) return std::nullopt;
      Response response{Vector(n_), std::nullopt, Vector(n_), 0};
      stiffness_.solve(rate(at), response.rate);
      stiffness_.solve(probe_, response.weakest);
      response.stiffness = 1 / space_.dot(probe_, response.weakest);
      if (path_.traits().exact_stiffness) response.unstable = stiffness_.negative_eigenvalues();
      return response;
    } catch (const RecoverableError&) {
      return std::nullopt;
    }
  }

  const Statistics& statistics() const override { return statistics_; }
  std::size_t factor_bytes() const override { return stiffness_.factor_bytes(); }
  std::string description() const override {
    return shown(options_.linear_solver) + " (" + stiffness_.description() + ")";
  }

 private:
  Attempt run(PathPoint& point, double longest) {
    callback_context_ = {};
    corrections_.clear();
    guess_ = point;
    auto x = view(unknowns_.get());
    x.head(n_) = point.q;
    x[n_] = point.lambda;
    require(KINSetMaxNewtonStep(memory_.get(), longest));
    const int flag = KINSol(memory_.get(), unknowns_.get(), KIN_NONE, position_weights_.get(), force_weights_.get());
    if (callback_context_.failure) std::rethrow_exception(callback_context_.failure);
    Attempt attempt;
    KINGetNumNonlinSolvIters(memory_.get(), &attempt.iterations);
    statistics_.newton_iterations += attempt.iterations;
    if (corrections_.size() > 1) attempt.contraction = corrections_[1] / corrections_[0];
    const bool within_tolerance = flag == KIN_SUCCESS || flag == KIN_INITIAL_GUESS_OK;
    attempt.found = within_tolerance || is_settled();
    if (attempt.found) {
      point = {x.head(n_), x[n_]};
      attempt.residual = space_.largest_entry(force(point));
      attempt.above_tolerance = !within_tolerance;
    } else {
      attempt.failure_reason = failure_message(flag, options_, path_.traits().exact_stiffness, callback_context_);
      attempt.names_remedy =
          callback_context_.recoverable_cause.is_limit() &&
          (flag == KIN_FIRST_SYSFUNC_ERR || flag == KIN_SYSFUNC_FAIL || flag == KIN_REPTD_SYSFUNC_ERR);
    }
    return attempt;
  }

  void initialise() {
    void* m = memory_.get();
    ORTHODYN_CAPTURE_ERRORS(KINSetErrHandlerFn, context_, m, &callback_context_.message);
    require(KINInit(
        m, [](N_Vector x, N_Vector r, void* user) { return self(user).evaluate(x, r); }, unknowns_.get()));
    require(KINSetUserData(m, this));
    functions_.setup = [this] { return factor(); };
    functions_.solve = [this](N_Vector dx, N_Vector b, double) {
      bool good = false;
      const int thrown = guarded(callback_context_, [&] { good = correct(view(b), view(dx)); });
      return thrown ? thrown : good ? 0 : 1;
    };
    placeholder_ = make_placeholder_matrix(context_);
    solver_ = make_solver_adapter(functions_, context_);
    require(KINSetLinearSolver(m, solver_.get(), placeholder_.get()));
    require(KINSetJacFn(
        m, [](N_Vector x, N_Vector, SUNMatrix, void* user, N_Vector, N_Vector) { return self(user).linearize(x); }));
    require(KINSetMaxSetupCalls(m, 1));
    require(KINSetNumMaxIters(m, options_.max_iterations));
    require(KINSetFuncNormTol(m, options_.rtol));
    require(KINSetScaledStepTol(m, 1e-3 * options_.rtol));
  }

  static Kinsol& self(void* user) { return *static_cast<Kinsol*>(user); }

  void require(int flag) const {
    if (flag < 0) throw RunError("kinsol could not be set up: " + callback_context_.message);
  }

  // Left side of the plane's equation at x.
  double distance(const ConstVectorRef& x) const {
    const double along = plane_->lambda * (x[n_] - guess_.lambda);
    return plane_->q ? along + space_.dot(*plane_->q, x.head(n_) - guess_.q) : along;
  }

  int evaluate(N_Vector x, N_Vector residual) {
    return guarded(callback_context_, [&] {
      const Measure measure(statistics_.force);
      auto out = view(residual);
      const auto at = view(x);
      path_.force(at[n_], at.head(n_), zero_velocity_, out.head(n_));
      if (!space_.is_finite(out.head(n_))) throw RecoverableError("the force is not finite");
      out = -out;
      out[n_] = distance(at);
    });
  }

  int linearize(N_Vector x) {
    return guarded(callback_context_, [&] {
      const auto at = view(x);
      if (descends_) {
        stiffness_.linearize(at[n_], at.head(n_), TangentKind::gauss_newton);
      } else {
        stiffness_.linearize_predicted(before_.lambda, before_.q, at[n_], at.head(n_));
        before_ = {at.head(n_), at[n_]};
      }
    });
  }

  int factor() {
    bool regular = false;
    const int thrown = guarded(callback_context_, [&] {
      regular = stiffness_.factor();
      if (descends_ && stiffness_.negative_eigenvalues().value_or(0) > 0) regular = false;  // round-off
    });
    return thrown ? thrown : regular ? 0 : 1;
  }

  // Solves J dx = b, where b is the negative residual. False if Newton's method must stop.
  bool correct(const ConstVectorRef& b, VectorRef dx) {
    auto dq = dx.head(n_);
    stiffness_.solve(b.head(n_), dq);
    if (!plane_->q) {  // the load factor is fixed
      dx[n_] = b[n_] / plane_->lambda;
    } else {
      Vector response(n_);
      stiffness_.solve(rate(before_), response);
      dx[n_] = (b[n_] - space_.dot(*plane_->q, dq)) / (space_.dot(*plane_->q, response) + plane_->lambda);
      dq += dx[n_] * response;
    }
    return space_.is_finite(dq) && contracts(space_.largest_entry(dq));
  }

  bool contracts(double correction) {
    corrections_.push_back(correction);
    const auto k = corrections_.size() - 1;
    return descends_ || k == 0 || correction <= corrections_[k - 1];
  }

  // df_lambda/dlambda. If supports move or loads follow the body, this evaluates forces.
  Vector rate(const PathPoint& at) {
    if (path_.has_constant_rate()) return path_.rate(at.lambda, at.q);
    const Measure measure(statistics_.force);
    return path_.rate(at.lambda, at.q);
  }

  Vector force(const PathPoint& at) const {
    Vector f(n_);
    path_.force(at.lambda, at.q, zero_velocity_, f);
    return f;
  }

  // True if one more Newton step, with the exact K, would be negligible. A short step with an approximate K proves
  // nothing about the solution.
  bool is_settled() {
    try {
      const auto x = view(unknowns_.get());
      const PathPoint at{x.head(n_), x[n_]};
      const Vector f = force(at);
      if (!space_.is_finite(f)) return false;
      stiffness_.linearize(at.lambda, at.q, TangentKind::exact);
      if (!stiffness_.factor()) return false;
      Vector correction(n_);
      stiffness_.solve(f, correction);
      const double motion = std::max(space_.largest_entry(at.q), 1e-3 * task_.length);
      return space_.largest_entry(correction) <=
             std::max(path_.traits().exact_stiffness ? options_.rtol : 0, kSolutionRoundOff) * motion;
    } catch (const RecoverableError&) {
      return false;
    }
  }

  const LoadPath& path_;
  VectorSpace space_;
  Eigen::Index n_;
  EquilibriumTask task_;
  KinsolOptions options_;
  Statistics statistics_;
  Vector zero_velocity_;
  PathStiffness stiffness_;
  Vector probe_;
  const PathPlane* plane_ = nullptr;
  PathPoint guess_;
  PathPoint before_;  // the previous iterate; at first the last equilibrium
  bool descends_ = false;
  std::vector<double> corrections_;  // largest entry of each iteration's correction
  CallbackContext callback_context_;
  SolverFunctions functions_;
  Context context_;
  OwnedVector unknowns_, position_weights_, force_weights_;  // every rank holds the load factor
  OwnedMatrix placeholder_;
  OwnedSolver solver_;
  std::unique_ptr<void, FreeKinsol> memory_;
};

}  // namespace

std::unique_ptr<EquilibriumSolver> make_kinsol(const LoadPath& path, const EquilibriumTask& task,
                                               const KinsolOptions& options) {
  return std::make_unique<Kinsol>(path, task, options);
}

}  // namespace orthodyn::sundials
