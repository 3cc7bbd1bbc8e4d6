// Diagonally implicit Runge-Kutta methods on q' = v, v' = a, M a = f(t, q, v):
//
//   Q_i = q0 + h sum_j a_ij V_j,   V_i = v0 + h sum_j a_ij A_j,   M A_i = f(t0 + c_i h, Q_i, V_i)
//
// Each stage has the weights w_d = h a_ii, w_k = w_d^2. Stage 0 is the beginning of the step, where A_0 is known;
// the last one is its end (stiffly accurate). One factorisation per distinct a_ii outlives the steps.
#pragma once

#include <memory>
#include <vector>

#include "integrators/native/accelerations.h"
#include "integrators/native/one_step.h"
#include "integrators/native/stage_solver.h"

namespace orthodyn {

struct DirkTable {
  int order, estimate;                 // of the method; the power of h in its error estimate
  std::vector<double> c;               // of stages 0 to s; c_0 = 0, c_s = 1
  std::vector<std::vector<double>> a;  // rows of stages 1 to s: a_i0 to a_ii
  std::vector<double> error;           // the local error is h sum_i error_i (V_i, A_i), i = 0 to s
};

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
  std::vector<StageSolver*> solver_of_;                // of stages 1 to s
  StageSolver::Stage stage_;
  Eigen::MatrixXd V_, A_;       // a column per stage
  Accelerations past_, tried_;  // until now(), and in the last attempt
};

}  // namespace orthodyn
