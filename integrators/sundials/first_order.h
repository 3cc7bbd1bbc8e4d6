// What CVODE and ARKODE share: the first-order form y' = (v, M^-1 f) of the model and its Newton matrix I - gamma J,
// with gamma in s.
#pragma once

#include "integrators/sundials/sundials_integrator.h"

namespace orthodyn::sundials {

class FirstOrderIntegrator : public SundialsIntegrator {
 protected:
  // Throws ConfigError for klu_full with a consistent mass, whose inverse is dense.
  FirstOrderIntegrator(const std::string& name, const Model& model, const Settings& settings);

  // Bodies of callbacks: they return 0, +1 (recoverable) or -1 (fatal) and throw nothing. y = (q, v) and y_dot are of
  // size 2n, a of size n.
  int evaluate(double t, N_Vector y, N_Vector y_dot);
  int evaluate_acceleration(const Model& model, double t, N_Vector y, VectorRef a);  // M^-1 f
  // K and D at y, unless `keep`: then only their combination is made anew, at factorisation. `renewed` is what SUNDIALS
  // is told of it.
  int linearize_reduced(double t, N_Vector y, bool keep, sunbooleantype* renewed);
  int fill_full(double t, N_Vector y, SUNMatrix J);

  // The reduced solve, at the gamma of the library's set-up.
  void make_first_order_solver(std::function<double()> gamma);
};

}  // namespace orthodyn::sundials
