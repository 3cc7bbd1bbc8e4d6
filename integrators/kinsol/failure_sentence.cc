#include "integrators/kinsol/failure_sentence.h"

#include <fmt/format.h>
#include <kinsol/kinsol.h>

namespace orthodyn::sundials {

std::string failure_sentence(int flag, const KinsolOptions& options, bool stiffness_is_exact,
                             const CallbackContext& context) {
  const std::string cause = context.recoverable_cause.empty() ? "" : " (" + context.recoverable_cause + ")";
  const std::string approximate = stiffness_is_exact
                                      ? ""
                                      : ", by a stiffness that is approximate: take elasticity.warped_tangent: "
                                        "unsymmetric and statics.solver.linear_solver: klu";
  switch (flag) {
    case KIN_MAXITER_REACHED:
      return fmt::format("Newton's method did not converge within {} iterations (statics.solver.max_iterations){}",
                         options.max_iterations, approximate);
    case KIN_LINSOLV_NO_RECOVERY: return "Newton's corrections do not contract" + approximate + cause;
    case KIN_LSETUP_FAIL: return "the stiffness is singular";
    case KIN_FIRST_SYSFUNC_ERR:
    case KIN_SYSFUNC_FAIL:
    case KIN_REPTD_SYSFUNC_ERR: return "the forces could not be evaluated" + cause;
    case KIN_STEP_LT_STPTOL: return "Newton's corrections have become too small for the residual that is left" + cause;
    default: return "KINSOL says: " + context.message;
  }
}

}  // namespace orthodyn::sundials
