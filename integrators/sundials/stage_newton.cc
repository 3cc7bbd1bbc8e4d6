#include "integrators/sundials/stage_newton.h"

#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <cmath>
#include <utility>

namespace orthodyn::sundials {

namespace {

constexpr double kMostGrowth = 2;    // of a correction; above it the stage fails, as in ARKODE
constexpr double kSameGamma = 1e-9;  // relative difference of equal gammas by round-off of the times

}  // namespace

StageNewton::StageNewton(N_Vector y, SUNContext context, std::function<Conditions()> conditions, bool linear,
                         double least_rate)
    : conditions_(std::move(conditions)),
      least_rate_(least_rate),
      solver_(SUNNonlinSol_Newton(y, context)),
      remaining_(linear) {
  if (!solver_) throw RunError("SUNDIALS could not create Newton's iteration", Reason::out_of_memory);
}

bool StageNewton::Conditions::operator==(const Conditions& other) const {
  return factorizations == other.factorizations && std::abs(gamma - other.gamma) <= kSameGamma * gamma;
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

int StageNewton::test(int iteration, double size, double tolerance) {
  const double last = std::exchange(last_, size);
  if (iteration == 0) {
    if (const Conditions now = conditions_(); now != measured_under_) {
      remaining_.restart();
      measured_under_ = now;
    }
    remaining_.begin();
  } else {
    const double ratio = size / last;
    if (!(ratio <= kMostGrowth)) return SUN_NLS_CONV_RECVR;
    if (ratio >= 1) return SUN_NLS_CONTINUE;
    remaining_.note(ratio);
  }
  return remaining_.after(size, least_rate_) <= tolerance ? 0 : SUN_NLS_CONTINUE;
}

}  // namespace orthodyn::sundials
