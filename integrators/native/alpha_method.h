// The generalised-alpha family (Chung & Hulbert 1993), in the form of Arnold & Bruels (2007): Newmark's formulas with
// an acceleration w of the scheme's own, which follows that of the solution, x.
//
//   q1 = q0 + h v0 + h^2 ((1/2 - beta) w0 + beta w1),    v1 = v0 + h ((1 - gamma) w0 + gamma w1)
//   [w1, w0]_m = [x1, x0]_f,    M x = f(t, q, v),        [y1, y0]_k = (1 - alpha_k) y1 + alpha_k y0
//
// The blend of forces, not the force of a blended state (Erlicher, Bonaventura & Bursi 2002): a stiff body that turns
// is in between smaller than it is, and its false stresses add energy. With theta = alpha_m - alpha_f, w is the
// solution's acceleration at t + theta h (Jansen, Whiting & Hulbert 2000), but for a share of (-alpha_m / (1 -
// alpha_m))^n n steps after a start; when h changes, it is moved there (Bruels & Arnold 2008). Second order for gamma =
// 1/2 - theta.
#pragma once

#include "integrators/native/accelerations.h"
#include "integrators/native/one_step.h"
#include "integrators/native/stage_solver.h"

namespace orthodyn {

struct AlphaParameters {
  double alpha_m, alpha_f, beta, gamma;

  double theta() const { return alpha_m - alpha_f; }
  int order() const;
};

class AlphaMethod : public OneStep {
 public:
  AlphaMethod(const std::string& name, const Model& model, const NewtonOptions& options, const Scales& scales,
              const AlphaParameters& parameters);
  std::size_t factor_bytes() const override { return solver_.factor_bytes(); }

 protected:
  Orders orders() const override { return {p_.order(), p_.order() + 1}; }
  bool balances_by_mean_velocity() const override { return true; }
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
  Accelerations past_;  // x at the ends of steps
  Vector w_, w0_, w1_;  // at now(), moved to where this step needs it, at the step's end
  double last_h_ = 0;   // 0 after a restart
  Vector last_change_;  // w1_ - w0_ of the last step
};

}  // namespace orthodyn
