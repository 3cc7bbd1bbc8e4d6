// Newton's iteration for the implicit stages of ARKODE. A test by the remaining error (remaining_error.h) replaces
// ARKODE's convergence test.
//
// The stages of a step share the matrix and gamma, so their corrections shrink at the same rate. ARKODE's test either
// requires the last correction itself to be below the tolerance, which takes one or two iterations too many, or uses
// the rate of earlier steps, which is too small after gamma has changed.
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

#include <functional>

#include "integrators/remaining_error.h"
#include "integrators/sundials/handles.h"

namespace orthodyn::sundials {

class StageNewton {
 public:
  // The convergence rate of earlier stages is used until one of these values changes.
  struct Conditions {
    long factorizations = 0;  // number so far
    double gamma = 0;         // s; a difference by round-off is no change
  };

  // `rtol`: relative tolerance of the error weights. `least_rate`: NewtonMatrix::least_rate().
  StageNewton(N_Vector y, SUNContext context, std::function<Conditions()> conditions, double rtol, double least_rate);
  StageNewton(const StageNewton&) = delete;
  StageNewton& operator=(const StageNewton&) = delete;

  // Pass the solver to ARKODE, which installs its own convergence test; then call replace_test().
  SUNNonlinearSolver get() const { return solver_.get(); }
  void replace_test();

 private:
  void begin_stage();
  int test(int iteration, double size, double tolerance);

  std::function<Conditions()> conditions_;
  double rtol_, least_rate_;
  Owned<SUNNonlinearSolver, SUNNonlinSolFree> solver_;
  Conditions now_;
  double factored_gamma_ = 0;  // gamma of the last factorisation, s
  RemainingError remaining_{false};
  double last_ = 0;  // norm of the last correction of this stage
};

}  // namespace orthodyn::sundials
