// Forward sensitivities by CVODES and IDAS (Serban & Hindmarsh 2005). Steps solve for them with the matrix of the
// motion (sensitivity_corrector.h). Their local errors are controlled, too (SensitivityEquations::scale()). This class
// has what both libraries share: the vectors y_i = (s, s') of all parameters, and the bodies of callbacks.
#pragma once

#include <vector>

#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/handles.h"
#include "lib/ode/model.h"
#include "lib/ode/sensitivity_equations.h"
#include "lib/ode/statistics.h"

namespace orthodyn::sundials {

class ForwardSensitivities {
 public:
  // `y`: a vector like the state. All references must outlive this object.
  ForwardSensitivities(SensitivityEquations& equations, const Model& model, N_Vector y, CallbackContext& callbacks,
                       Statistics& statistics);

  int count() const { return equations_.count(); }
  N_Vector* values() { return values_.data(); }
  N_Vector* derivatives() { return derivatives_.data(); }
  std::vector<double> scales() const;

  // Absolute tolerances. With them and the relative tolerance `rtol`, an error of the sensitivity s_i with respect to p
  // is allowed that is rtol times |s_i| plus the motion's own tolerance over the scale of p. Without the first part,
  // lightly damped motions would need ever smaller steps, because their sensitivities grow with time. `scales`: of the
  // motion.
  N_Vector* tolerances(double rtol, const Scales& scales);

  // Sets values() to their initial values.
  void start();
  // Sets derivatives() for values() at a state y with derivative y_dot. Throws RecoverableError.
  void make_consistent(double t, N_Vector y, N_Vector y_dot);

  // Bodies of callbacks. They return 0, +1 (recoverable) or -1 (fatal) and throw nothing.
  //
  // CVODES: the derivative of y_i at a state y with derivative y_dot.
  int first_order(int i, double t, N_Vector y, N_Vector y_dot, N_Vector s, N_Vector s_dot);
  // IDAS: the residuals (s' - s_v, M s_v' - force) of all parameters.
  int residual(double t, N_Vector y, N_Vector y_dot, N_Vector* s, N_Vector* s_dot, N_Vector* out);

  // Reads a vector like y.
  static State state(double t, N_Vector y) { return {t, positions(y), velocities(y)}; }

  std::size_t bytes() const;

 private:
  void compute_force(int i, double t, N_Vector y, N_Vector y_dot, N_Vector s, VectorRef out);

  SensitivityEquations& equations_;
  const Model& model_;
  CallbackContext& callbacks_;
  Statistics& statistics_;
  std::vector<OwnedVector> owned_;
  std::vector<N_Vector> values_, derivatives_, tolerances_;  // of owned_
};

}  // namespace orthodyn::sundials
