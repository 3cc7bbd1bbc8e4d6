#include "integrators/sundials/secant_newton.h"

#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <algorithm>
#include <utility>

namespace orthodyn::sundials {

namespace {

constexpr double kFastest = 0.3;     // a rate falls by at most this factor from one estimate to the next, as in CVODE
constexpr double kParallel = 1e-12;  // least share of a secant's square that is orthogonal to the other secant
constexpr double kGivenUp = 2;       // growth of a correction above which the solve fails, as in CVODE

}  // namespace

SecantNewton::SecantNewton(N_Vector y, SUNContext context, CallbackContext& callbacks, const VectorSpace& space,
                           double least_rate)
    : newton_(SUNNonlinSol_Newton(y, context)),
      solver_(SUNNonlinSolNewEmpty(context)),
      callbacks_(callbacks),
      least_rate_(least_rate),
      space_(space) {
  if (!newton_ || !solver_) throw RunError("SUNDIALS could not create Newton's iteration", Reason::out_of_memory);
  solver_->content = this;
  plain_.setZero(view(y).size());
  change_.fill(plain_);
  effect_.fill(plain_);
  delegate();
}

void SecantNewton::delegate() {
  auto& ops = *solver_->ops;
  ops.gettype = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_ROOTFIND; };
  ops.initialize = [](SUNNonlinearSolver S) { return SUNNonlinSolInitialize(of(S).newton_.get()); };
  ops.solve = [](SUNNonlinearSolver S, N_Vector y0, N_Vector y, N_Vector w, sunrealtype tolerance,
                 sunbooleantype set_up, void* memory) { return of(S).solve(y0, y, w, tolerance, set_up, memory); };
  ops.free = [](SUNNonlinearSolver S) {
    S->content = nullptr;
    SUNNonlinSolFreeEmpty(S);
    return 0;
  };
  ops.setsysfn = [](SUNNonlinearSolver S, SUNNonlinSolSysFn f) {
    of(S).system_ = f;
    return SUNNonlinSolSetSysFn(of(S).newton_.get(), [](N_Vector y, N_Vector F, void* me) {
      auto& s = *static_cast<SecantNewton*>(me);
      return s.system_(y, F, s.memory_);
    });
  };
  ops.setlsetupfn = [](SUNNonlinearSolver S, SUNNonlinSolLSetupFn f) {
    of(S).set_up_ = f;
    return SUNNonlinSolSetLSetupFn(of(S).newton_.get(), [](sunbooleantype bad, sunbooleantype* current, void* me) {
      auto& s = *static_cast<SecantNewton*>(me);
      s.first_rate_ = 1;
      return s.set_up_(bad, current, s.memory_);
    });
  };
  ops.setlsolvefn = [](SUNNonlinearSolver S, SUNNonlinSolLSolveFn f) {
    of(S).solve_ = f;
    return SUNNonlinSolSetLSolveFn(of(S).newton_.get(),
                                   [](N_Vector b, void* me) { return static_cast<SecantNewton*>(me)->correct(b); });
  };
  ops.setctestfn = [](SUNNonlinearSolver S, SUNNonlinSolConvTestFn, void*) {
    return SUNNonlinSolSetConvTestFn(
        of(S).newton_.get(),
        [](SUNNonlinearSolver, N_Vector, N_Vector step, sunrealtype tolerance, N_Vector weights, void* me) {
          return static_cast<SecantNewton*>(me)->test(N_VWrmsNorm(step, weights), tolerance);
        },
        &of(S));
  };
  ops.setmaxiters = [](SUNNonlinearSolver S, int most) { return SUNNonlinSolSetMaxIters(of(S).newton_.get(), most); };
  ops.getnumiters = [](SUNNonlinearSolver S, long* n) { return SUNNonlinSolGetNumIters(of(S).newton_.get(), n); };
  ops.getcuriter = [](SUNNonlinearSolver S, int* n) { return SUNNonlinSolGetCurIter(of(S).newton_.get(), n); };
  ops.getnumconvfails = [](SUNNonlinearSolver S, long* n) {
    return SUNNonlinSolGetNumConvFails(of(S).newton_.get(), n);
  };
}

int SecantNewton::solve(N_Vector y0, N_Vector y, N_Vector weights, sunrealtype tolerance, sunbooleantype set_up,
                        void* memory) {
  memory_ = memory;
  weights_ = weights;
  return SUNNonlinSolSolve(newton_.get(), y0, y, weights, tolerance, set_up, this);
}

int SecantNewton::iteration() const {
  int i = 0;
  SUNNonlinSolGetCurIter(newton_.get(), &i);
  return i;
}

int SecantNewton::correct(N_Vector b) {
  if (const int flag = solve_(b, memory_); flag != 0) return flag;
  if (iteration() == 1) first_rate_ = std::max(kFastest * first_rate_, N_VWrmsNorm(b, weights_) / first_size_);
  return guarded(callbacks_, [&] { store(view(b)); });
}

void SecantNewton::store(VectorRef d) {
  plain_ = d;
  if (iteration() == 0) {  // a new step or matrix
    known_ = 0;
  } else {
    effect_[0] += plain_;
    change_[0] += effect_[0];
    known_ = std::min(known_ + 1, kDepth);
    apply_secants(d);
  }
  std::rotate(change_.rbegin(), change_.rbegin() + 1, change_.rend());
  std::rotate(effect_.rbegin(), effect_.rbegin() + 1, effect_.rend());
  change_[0] = d;
  effect_[0] = -plain_;
}

int SecantNewton::test(double size, double tolerance) {
  if (iteration() == 0) {
    first_size_ = size;
    rate_ = first_rate_;
  } else {
    rate_ = std::max(kFastest * rate_, size / last_size_);
  }
  const double last = std::exchange(last_size_, size);
  if (size * std::clamp(rate_, least_rate_, 1.0) <= tolerance) return 0;
  return iteration() > 0 && size > kGivenUp * last ? SUN_NLS_CONV_RECVR : SUN_NLS_CONTINUE;
}

void SecantNewton::apply_secants(VectorRef d) const {
  const auto product = [&](const auto& x, const auto& y) {
    return space_.sum(view(weights_).cwiseAbs2().cwiseProduct(x).dot(y));
  };
  const auto& [first, second] = effect_;
  const double a11 = product(first, first), b1 = product(first, d);
  if (!(a11 > 0)) return;
  double g1 = b1 / a11, g2 = 0;
  if (known_ == 2) {
    const double a12 = product(first, second), a22 = product(second, second);
    const double pivot = a22 - a12 * a12 / a11;  // small if the two are parallel
    if (pivot > kParallel * a22) {
      g2 = (product(second, d) - a12 * g1) / pivot;
      g1 -= a12 / a11 * g2;
    }
  }
  d -= g1 * change_[0];
  if (g2 != 0) d -= g2 * change_[1];  // with one secant, entry 1 is left from an earlier solve and may be NaN
}

}  // namespace orthodyn::sundials
