#include "integrators/sundials/newton_at_kinks.h"

#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <utility>

namespace orthodyn::sundials {

namespace {

constexpr double kRoundOff = 1e-11;  // of the scales: corrections below it need no other one
constexpr double kShare = 0.1;       // of what is allowed to Newton's method for smooth forces
constexpr double kDiverging = 0.9;   // a rate at which a new matrix or a shorter step is needed

}  // namespace

NewtonAtKinks::NewtonAtKinks(double rtol, N_Vector y, SUNContext context)
    : rtol_(rtol), solver_(SUNNonlinSol_Newton(y, context)) {
  if (!solver_) throw RunError("SUNDIALS could not create Newton's iteration", Reason::out_of_memory);
}

void NewtonAtKinks::replace_test() { SUNNonlinSolSetConvTestFn(solver_.get(), test, this); }

int NewtonAtKinks::test(SUNNonlinearSolver solver, N_Vector, N_Vector correction, sunrealtype tolerance,
                        N_Vector weights, void* user) {
  auto& me = *static_cast<NewtonAtKinks*>(user);
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
