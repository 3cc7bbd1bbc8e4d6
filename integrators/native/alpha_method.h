// The generalised-alpha family (Chung & Hulbert 1993) in the form of Arnold & Bruels (2007): Newmark's formulas with an
// auxiliary acceleration w, which follows the acceleration x of the solution. Indices 0 and 1 denote the ends of a step
// h. With the weighted mean [y1, y0]_c = (1 - c) y1 + c y0,
//
//   q1 = q0 + h v0 + h^2 ((1/2 - beta) w0 + beta w1),    v1 = v0 + h ((1 - gamma) w0 + gamma w1),
//   [w1, w0]_alpha_m = [x1, x0]_alpha_f,    M x = f(t, q, v).
//
// Forces are averaged, not states (Erlicher, Bonaventura & Bursi 2002). A stiff body at the average of two rotated
// positions would be too small, and the spurious stresses would add energy.
//
// w approximates the solution's acceleration at t + theta h, theta = alpha_m - alpha_f (Jansen, Whiting & Hulbert
// 2000). At a start w = x; each step multiplies the error of w by -alpha_m / (1 - alpha_m). When h changes, w is
// shifted to the new time t + theta h (Bruels & Arnold 2008). The order is 2 if gamma = 1/2 - theta, else 1.
//
// With constraints (lib/ode/constraints.h), M x = f - G^T lambda and g(t, q1) = 0: the form of index 3 (Arnold & Bruels
// 2007), of the same order in q, v and lambda. Velocities violate dg/dt = 0 by O(h^2), which does not add up. At a
// start and where h changes, the parts of w and lambda along the constraints have an error of O(h), which decays at
// the rate of the fastest oscillations. A method that keeps these is refused.
#pragma once

#include "integrators/native/acceleration_predictor.h"
#include "integrators/native/one_step.h"
#include "integrators/native/stage_solver.h"

namespace orthodyn {

struct AlphaParameters {
  double alpha_m, alpha_f, beta, gamma;

  double theta() const { return alpha_m - alpha_f; }
  int order() const;
  // True if the spectral radius is below 1 in the limit of fast oscillations.
  bool damps_fastest() const { return gamma > 0.5 && 2 * beta > gamma && alpha_f < 0.5; }
};

class AlphaMethod : public OneStep {
 public:
  // Throws ConfigError if the model has constraints and the method keeps the fastest oscillations, or if the linear
  // solver does not accept the model's matrices.
  AlphaMethod(const std::string& name, const Model& model, const NewtonOptions& options, const Scales& scales,
              const AlphaParameters& parameters);
  std::size_t factor_bytes() const override { return solver_.factor_bytes(); }

 protected:
  Orders orders() const override { return {p_.order(), p_.order() + 1}; }
  bool balances_by_mean_velocity() const override { return true; }
  double largest_growth() const override;
  void restarted() override;
  bool attempt(double h) override;
  void estimate(double h, VectorRef e_q, VectorRef e_v) override;
  void accepted(double h) override;
  std::string solver_description() const override { return solver_.description(); }
  std::size_t method_bytes() const override;

 private:
  AlphaParameters p_;
  StageSolver solver_;
  StageSolver::Stage stage_;
  AccelerationPredictor predictor_;  // predicts x from its values at the ends of steps
  Vector w_, w0_, w1_;               // w at now(); w at now(), shifted for the current h; w at the end of the step
  double last_h_ = 0;                // s; 0 after a restart
  Vector last_change_;               // w1_ - w0_ of the last step
};

}  // namespace orthodyn
