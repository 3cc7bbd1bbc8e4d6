#include "integrators/sundials/nonsmooth_newton.h"

#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <utility>

namespace orthodyn::sundials {

namespace {

constexpr double kRoundOff = 1e-11;  // relative to the scales: corrections below it are accepted
constexpr double kShare = 0.1;       // tolerance as a share of the tolerance for smooth forces
constexpr double kDiverging = 0.9;   // rate above which a new matrix or a shorter step is needed

}  // namespace

NonsmoothNewton::NonsmoothNewton(double rtol, N_Vector y, SUNContext context)
    : rtol_(rtol), solver_(SUNNonlinSol_Newton(y, context)) {
  if (!solver_) throw RunError("SUNDIALS could not create Newton's iteration", Reason::out_of_memory);
}

void NonsmoothNewton::replace_test() { SUNNonlinSolSetConvTestFn(solver_.get(), test, this); }

int NonsmoothNewton::test(SUNNonlinearSolver solver, N_Vector, N_Vector correction, sunrealtype tolerance,
                          N_Vector weights, void* user) {
  auto& me = *static_cast<NonsmoothNewton*>(user);
  const double size = N_VWrmsNorm(correction, weights);
  int iteration = 0;
  SUNNonlinSolGetCurIter(solver, &iteration);
  const double last = std::exchange(me.last_, size);
  if (size * me.rtol_ <= kRoundOff) return 0;
  if (iteration == 0) return SUN_NLS_CONTINUE;
  const double rate = size / last;
  if (!(rate <= kDiverging)) return SUN_NLS_CONV_RECVR;
  return size * rate / (1 - rate) <= kShare * tolerance ? 0 : SUN_NLS_CONTINUE;
}

}  // namespace orthodyn::sundials
