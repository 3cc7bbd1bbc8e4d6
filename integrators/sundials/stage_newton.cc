#include "integrators/sundials/stage_newton.h"

#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace orthodyn::sundials {

namespace {

constexpr double kMostGrowth = 2.3;       // of a correction; above it the stage fails, as in ARKODE
constexpr double kSameGamma = 1e-12;      // relative difference between equal gammas by round-off of the times
constexpr double kStageRoundOff = 1e-11;  // relative to the scales: corrections below it need not shrink

}  // namespace

StageNewton::StageNewton(N_Vector y, SUNContext context, std::function<Conditions()> conditions, double rtol,
                         double least_rate)
    : conditions_(std::move(conditions)),
      rtol_(rtol),
      least_rate_(least_rate),
      solver_(SUNNonlinSol_Newton(y, context)) {
  if (!solver_) throw RunError("SUNDIALS could not create Newton's iteration", Reason::out_of_memory);
}

void StageNewton::replace_test() {
  SUNNonlinSolSetConvTestFn(
      solver_.get(),
      [](SUNNonlinearSolver solver, N_Vector, N_Vector correction, sunrealtype tolerance, N_Vector weights, void* me) {
        int iteration = 0;
        SUNNonlinSolGetCurIter(solver, &iteration);
        return static_cast<StageNewton*>(me)->test(iteration, N_VWrmsNorm(correction, weights), tolerance);
      },
      this);
}

void StageNewton::begin_stage() {
  const Conditions last = std::exchange(now_, conditions_());
  const bool factored = now_.factorizations != last.factorizations;
  if (factored) factored_gamma_ = now_.gamma;
  if (factored || std::abs(now_.gamma - last.gamma) > kSameGamma * now_.gamma) remaining_.restart();
  remaining_.begin();
}

int StageNewton::test(int iteration, double size, double tolerance) {
  const double last = std::exchange(last_, size);
  if (iteration == 0) {
    begin_stage();
  } else {
    const double ratio = size / last;
    if (ratio >= 1 && size * rtol_ <= kStageRoundOff) return 0;
    if (!(ratio <= kMostGrowth)) return SUN_NLS_CONV_RECVR;
    if (ratio >= 1) return SUN_NLS_CONTINUE;
    remaining_.note(ratio);
  }
  // With the matrix of another gamma, corrections of undamped linear modes shrink by this ratio, as ARKODE scales them.
  const double drift = now_.gamma / factored_gamma_;
  const double least = std::max(least_rate_, std::abs(drift - 1) / (drift + 1));
  return remaining_.after(size, least) <= tolerance ? 0 : SUN_NLS_CONTINUE;
}

}  // namespace orthodyn::sundials
