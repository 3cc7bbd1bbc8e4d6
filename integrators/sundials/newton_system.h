// The linear systems of Newton's method in CVODE, ARKODE and IDA, as a SUNLinearSolver.
//
//   first order, y' = (v, M^-1 f):           (I - gamma J) x = b,          CVODE and ARKODE; gamma in s
//   residual, F = (q' - v, M v' - f) = 0:    (dF/dy + cj dF/dy') x = b,    IDA; gamma = 1/cj
//
// Internal variables z (lib/ode/internal_variables.h) are eliminated: with w = r_z / (1 + gamma / tau) for the
// right-hand side r_z of their rows, strains e and the force's derivative G by z,
//     dz = w + gamma / (tau + gamma) de/dq dq,   p contains gamma G w,   K contains -G gamma / (tau + gamma) de/dq.
//
// `linear_solver: klu_full` factors the 2n x 2n matrix by SUNDIALS' KLU (full_jacobian.h). All other solvers factor one
// n x n matrix (reduced_solve.h).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "integrators/reduced_solve.h"
#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/constraint_solve.h"
#include "integrators/sundials/full_jacobian.h"
#include "integrators/sundials/solver_adapter.h"
#include "integrators/sundials/sundials_options.h"
#include "lib/ode/internal_model.h"

namespace orthodyn::sundials {

class NewtonSystem {
 public:
  // Throws ConfigError if the solver does not accept the model's matrices. All references must outlive this object.
  NewtonSystem(const Model& model, const Options& options, const Scales& scales, Statistics& statistics,
               CallbackContext& callbacks);
  NewtonSystem(const NewtonSystem&) = delete;
  NewtonSystem& operator=(const NewtonSystem&) = delete;

  // Create solver() and matrix(). `gamma` returns the library's gamma (s) at the set-up. Both throw RunError if memory
  // is short.
  void create_first_order(SUNContext context, std::function<double()> gamma);
  void create_residual(SUNContext context);

  bool is_full() const { return full_.has_value(); }
  SUNLinearSolver solver() const { return solver_.get(); }
  SUNMatrix matrix() const { return matrix_.get(); }

  // Bodies of callbacks. They return 0, +1 (recoverable) or -1 (fatal) and throw nothing.
  //
  // First order, reduced: computes K and D at y. With `keep`, the last K and D are kept, and the next set-up only
  // rebuilds A. Sets *renewed = !keep, as SUNDIALS requires.
  int linearize(double t, N_Vector y, bool keep, sunbooleantype* renewed);
  // First order, full: computes J at y.
  int fill_jacobian(double t, N_Vector y, SUNMatrix J);
  // Residual form: computes K and D (reduced; J is unused) or J = dF/dy + cj dF/dy' (full) at y. `cj` in 1/s.
  int linearize_residual(double t, double cj, N_Vector y, SUNMatrix J);

  // The directions A^-1 G^T of the last set-up in which the forces of constraints move the model. Precondition: the
  // model has constraints.
  const Eigen::MatrixXd& constraint_directions() const { return constraints_->directions(); }

  double least_rate() const { return reduced_ ? reduced_->least_rate() : 0; }  // see NewtonMatrix::least_rate()
  std::size_t factor_bytes() const { return reduced_ ? reduced_->factor_bytes() : klu_factor_bytes(klu_.get()); }
  std::size_t bytes() const { return reduced_ ? reduced_->bytes() : 0; }
  std::string description() const { return reduced_ ? " (" + reduced_->description() + ")" : ""; }

 private:
  void create_reduced(SUNContext context, std::function<double()> gamma, std::function<void(N_Vector x, N_Vector b)>);
  // Computes K and D for the reduced solve at y. `gamma`: of the next factorisation, s.
  void linearize_reduced(double t, N_Vector y, double gamma);
  // Solves for x = (dq, dv, dz, dlambda, dmu), with momentum_ = p without G w, and r_q in x. `scale` times the part z
  // of b is r_z.
  void solve_reduced(N_Vector x, N_Vector b, double scale);
  void create_full(SUNContext context);
  void linearize_full(double t, N_Vector y);

  const Model& model_;
  const Options& options_;
  const Scales& scales_;
  Statistics& statistics_;
  CallbackContext& callbacks_;
  Vector momentum_;
  double gamma_ = 0;  // residual form: 1/cj of the last set-up, s
  std::function<double()> library_gamma_;
  std::optional<GivenInternalModel> internal_;  // only for models with internal variables
  Extra extra_;                                 // numbers of internal variables and multipliers in x and b
  std::optional<ConstraintSolve> constraints_;  // only for models with constraints
  double t_ = 0;                                // s, with q_ and z_: at which internal variables were linearised
  Vector q_, z_, w_, work_, b_1_, b_2_, dlambda_;
  std::optional<ReducedSolve> reduced_;
  std::optional<FullJacobian> full_;
  Linearization linearization_;  // used only by klu_full
  SolverFunctions functions_;    // declared before the adapter that calls them
  OwnedMatrix matrix_;
  OwnedSolver klu_, solver_;  // with klu_full, `solver_` calls `klu_`
};

}  // namespace orthodyn::sundials
