// Diagonally implicit Runge-Kutta methods on q' = v, v' = a, M a = f(t, q, v):
//
//   Q_i = q0 + h sum_j a_ij V_j,   V_i = v0 + h sum_j a_ij A_j,   M A_i = f(t0 + c_i h, Q_i, V_i)
//
// The Newton matrix of stage i is M + w_d D + w_k K with w_d = h a_ii, w_k = w_d^2. Stage 0 is the start of the step,
// where A_0 is known. The last stage is the end of the step (stiffly accurate). One factorisation per distinct a_ii is
// kept across steps.
#pragma once

#include <memory>
#include <vector>

#include "integrators/native/acceleration_predictor.h"
#include "integrators/native/one_step.h"
#include "integrators/native/stage_solver.h"

namespace orthodyn {

struct DirkTable {
  int order, estimate;                 // order of the method; power of h in its error estimate
  std::vector<double> c;               // times of stages 0 to s as fractions of the step; c_0 = 0, c_s = 1
  std::vector<std::vector<double>> a;  // one row per stage i = 1 to s: a_i0 to a_ii
  std::vector<double> error;           // the local error is h sum_i error_i (V_i, A_i), i = 0 to s
};

// Butcher table of a composite method for y = (q, v) with slope f(y). The trapezoidal rule gives y_g at the fraction
// g of the step; then
//
//   y1 = y0 + h (q0 f(y0) + q1 f(y_g) + q2 f(y1)),    q0 = 1 - q1 - q2,    q1 g + q2 = 1/2.
//
// Both stages have order two. The error estimate is the difference from the quadrature of order three with the same
// three slopes (Hosea & Shampine 1996).
DirkTable composite_table(double g, double q1, double q2);

class Dirk : public OneStep {
 public:
  Dirk(const std::string& name, const Model& model, const NewtonOptions& options, const Scales& scales,
       DirkTable table);
  std::size_t factor_bytes() const override;

 protected:
  Orders orders() const override { return {table_.order, table_.estimate}; }
  void restarted() override;
  bool attempt(double h) override;
  void estimate(double h, VectorRef e_q, VectorRef e_v) override;
  void accepted(double h) override;
  std::string solver_description() const override { return solvers_.front()->description(); }
  std::size_t method_bytes() const override;

 private:
  bool solve_stage(Eigen::Index i, double h);

  DirkTable table_;
  std::vector<std::unique_ptr<StageSolver>> solvers_;  // one per distinct a_ii
  std::vector<StageSolver*> solver_of_;                // solvers of stages 1 to s
  StageSolver::Stage stage_;
  Eigen::MatrixXd V_, A_;                                // a column per stage
  AccelerationPredictor predictor_, attempt_predictor_;  // from accepted steps; from these and the last attempt
};

}  // namespace orthodyn
