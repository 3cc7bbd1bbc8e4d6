#include "integrators/kinsol/kinsol.h"

#include <kinsol/kinsol.h>
#include <kinsol/kinsol_ls.h>

#include <algorithm>
#include <cmath>

#include "integrators/kinsol/failure_sentence.h"
#include "integrators/kinsol/path_stiffness.h"
#include "integrators/random_vector.h"
#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/solver_adapter.h"

namespace orthodyn::sundials {
namespace {

struct FreeKinsol {
  void operator()(void* memory) const { KINFree(&memory); }
};

constexpr double kRoundOff = 1e-11;  // of the motion

Vector unit_random_vector(const Model& model) {
  const Vector b = random_vector(model);
  return b / model.space().norm(b);
}

class Kinsol : public EquilibriumSolver {
 public:
  Kinsol(const LoadPath& path, const EquilibriumTask& task, const KinsolOptions& options)
      : path_(path),
        space_(path.space()),
        n_(path.num_dofs()),
        task_(task),
        options_(options),
        still_(Vector::Zero(n_)),
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
    constexpr double kUnlimited = 1e12;  // of the motion's size
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
      stiffness_.exact(at.lambda, at.q);
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
      attempt.failure_reason = failure_sentence(flag, options_, path_.traits().exact_stiffness, callback_context_);
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
    plug_ = make_placeholder_matrix(context_);
    solver_ = make_solver_adapter(functions_, context_);
    require(KINSetLinearSolver(m, solver_.get(), plug_.get()));
    require(KINSetJacFn(
        m, [](N_Vector x, N_Vector, SUNMatrix, void* user, N_Vector, N_Vector) { return self(user).linearize(x); }));
    require(KINSetMaxSetupCalls(m, 1));
    require(KINSetNumMaxIters(m, options_.max_iterations));
    require(KINSetFuncNormTol(m, options_.rtol));
    require(KINSetScaledStepTol(m, 1e-3 * options_.rtol));
  }

  static Kinsol& self(void* user) { return *static_cast<Kinsol*>(user); }

  void require(int flag) const {
    if (flag < 0) throw RunError("kinsol refused its set-up: " + callback_context_.message);
  }

  // How far from the plane.
  double distance(const ConstVectorRef& x) const {
    const double along = plane_->lambda * (x[n_] - guess_.lambda);
    return plane_->q ? along + space_.dot(*plane_->q, x.head(n_) - guess_.q) : along;
  }

  int evaluate(N_Vector x, N_Vector residual) {
    return guarded(callback_context_, [&] {
      const Measure measure(statistics_.force);
      auto out = view(residual);
      const auto at = view(x);
      path_.force(at[n_], at.head(n_), still_, out.head(n_));
      if (!space_.is_finite(out.head(n_))) throw RecoverableError("the force is not finite");
      out = -out;
      out[n_] = distance(at);
    });
  }

  int linearize(N_Vector x) {
    return guarded(callback_context_, [&] {
      const auto at = view(x);
      if (descends_) {
        stiffness_.semidefinite(at[n_], at.head(n_));
      } else {
        stiffness_.mixed(before_.lambda, before_.q, at[n_], at.head(n_));
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

  // dx = -J^-1 r, b = -r; whether Newton's method is to go on.
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

  // df_lambda/dlambda: forces are evaluated for it where supports move or loads follow the body.
  Vector rate(const PathPoint& at) {
    if (path_.has_constant_rate()) return path_.rate(at.lambda, at.q);
    const Measure measure(statistics_.force);
    return path_.rate(at.lambda, at.q);
  }

  Vector force(const PathPoint& at) const {
    Vector f(n_);
    path_.force(at.lambda, at.q, still_, f);
    return f;
  }

  // Whether one more Newton step would change next to nothing. One by an approximate K may be short far from there.
  bool is_settled() {
    try {
      const auto x = view(unknowns_.get());
      const PathPoint at{x.head(n_), x[n_]};
      const Vector f = force(at);
      if (!space_.is_finite(f)) return false;
      stiffness_.exact(at.lambda, at.q);
      if (!stiffness_.factor()) return false;
      Vector correction(n_);
      stiffness_.solve(f, correction);
      const double motion = std::max(space_.largest_entry(at.q), 1e-3 * task_.length);
      return space_.largest_entry(correction) <=
             std::max(path_.traits().exact_stiffness ? options_.rtol : 0, kRoundOff) * motion;
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
  Vector still_;  // velocities
  PathStiffness stiffness_;
  Vector probe_;
  const PathPlane* plane_ = nullptr;
  PathPoint guess_;
  PathPoint before_;  // the iterate before the present one
  bool descends_ = false;
  std::vector<double> corrections_;  // the largest of each iteration
  CallbackContext callback_context_;
  SolverFunctions functions_;
  Context context_;
  OwnedVector unknowns_, position_weights_, force_weights_;  // of several ranks each has the load factor
  OwnedMatrix plug_;
  OwnedSolver solver_;
  std::unique_ptr<void, FreeKinsol> memory_;
};

}  // namespace

std::unique_ptr<EquilibriumSolver> make_kinsol(const LoadPath& path, const EquilibriumTask& task,
                                               const KinsolOptions& options) {
  return std::make_unique<Kinsol>(path, task, options);
}

}  // namespace orthodyn::sundials
