// Newton's iteration for forces with kinks, such as contact.
//
// CVODE and IDA judge the first correction by the convergence rate of earlier steps; ARKODE accepts it. If the force
// has a kink between the predicted and the corrected state, both tests are unreliable: the force of the accepted state
// may be wrong by any factor. Here the first correction, unless it is round-off, is always followed by a second one,
// computed from the force at the corrected state. The iteration stops when the remaining error is at most a tenth of
// the tolerance for smooth forces. This error is estimated from the last correction and its ratio to the correction
// before: if the matrix is far too stiff, corrections are small and hardly shrink, although the error is large.
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

  // The solver for the library's Set...NonlinearSolver(), which installs the library's convergence test.
  SUNNonlinearSolver get() const { return solver_.get(); }
  // Replaces the library's test by the test described above; call it after Set...NonlinearSolver().
  void replace_test();

 private:
  static int test(SUNNonlinearSolver solver, N_Vector y, N_Vector correction, sunrealtype tolerance, N_Vector weights,
                  void* me);

  double rtol_;
  Owned<SUNNonlinearSolver, SUNNonlinSolFree> solver_;
  double last_ = 0;  // norm of the last correction in this step
};

}  // namespace orthodyn::sundials
