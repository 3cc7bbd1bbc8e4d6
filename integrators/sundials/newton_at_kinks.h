// Newton's iteration for forces with kinks, such as contact.
//
// CVODE and IDA judge a first correction by the rate of convergence of earlier steps, ARKODE by none. Where the force
// has a kink between the predicted and the corrected state, either means nothing: the correction is accepted, and with
// it a force that may be off by any factor. Here every correction but one of the size of round-off is followed by
// another one, from the force at the corrected state, and what is left is estimated by the rate of the two: with a
// matrix that is far too stiff corrections are small and do not shrink. The tolerance is a tenth of that for smooth
// forces.
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

#include "integrators/sundials/handles.h"

namespace orthodyn::sundials {

class NewtonAtKinks {
 public:
  // `rtol` is that of the weights.
  NewtonAtKinks(double rtol, N_Vector y, SUNContext context);
  NewtonAtKinks(const NewtonAtKinks&) = delete;
  NewtonAtKinks& operator=(const NewtonAtKinks&) = delete;

  // To be handed to the library, which puts in its own test.
  SUNNonlinearSolver get() const { return solver_.get(); }
  // After that.
  void replace_test();

 private:
  static int test(SUNNonlinearSolver solver, N_Vector y, N_Vector correction, sunrealtype tolerance, N_Vector weights,
                  void* me);

  double rtol_;
  Owned<SUNNonlinearSolver, SUNNonlinSolFree> solver_;
  double last_ = 0;  // size of the last correction of this step
};

}  // namespace orthodyn::sundials
