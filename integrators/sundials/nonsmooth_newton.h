// Newton's iteration for forces with kinks, such as contact.
//
// CVODE and IDA judge the first correction by the convergence rate of earlier steps; ARKODE accepts it. If the force
// has a kink between the predicted and the corrected state, both tests fail: the accepted force may be wrong by any
// factor. Here the first correction, unless it is round-off, is always followed by a second one, computed from the
// force at the corrected state. The iteration stops when the remaining error is below a tenth of the tolerance for
// smooth forces. This error is estimated from the last correction and its ratio to the one before, because corrections
// with a far too stiff matrix are small without shrinking.
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

#include "integrators/sundials/handles.h"

namespace orthodyn::sundials {

class NonsmoothNewton {
 public:
  // `rtol`: relative tolerance of the error weights.
  NonsmoothNewton(double rtol, N_Vector y, SUNContext context);
  NonsmoothNewton(const NonsmoothNewton&) = delete;
  NonsmoothNewton& operator=(const NonsmoothNewton&) = delete;

  // Pass it to the library's Set...NonlinearSolver(), which installs the library's convergence test.
  SUNNonlinearSolver get() const { return solver_.get(); }
  // Replaces that test by the test described above; call it after Set...NonlinearSolver().
  void replace_test();

 private:
  static int test(SUNNonlinearSolver solver, N_Vector y, N_Vector correction, sunrealtype tolerance, N_Vector weights,
                  void* me);

  double rtol_;
  Owned<SUNNonlinearSolver, SUNNonlinSolFree> solver_;
  double last_ = 0;  // norm of the last correction in this step
};

}  // namespace orthodyn::sundials
