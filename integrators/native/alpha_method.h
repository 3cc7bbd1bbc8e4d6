// The generalised-alpha family (Chung & Hulbert 1993): Newmark's formulas, with the equation of motion
// satisfied between the ends of the step.
//
//   q1 = q0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1),    v1 = v0 + h ((1 - gamma) a0 + gamma a1)
//   M [a1, a0]_m = f(t, [q1, q0]_f, [v1, v0]_f),         [x1, x0]_k = (1 - alpha_k) x1 + alpha_k x0
//
// The force of the blended state, not the blend of forces. With theta = alpha_m - alpha_f the scheme's
// acceleration is that of the solution at t + theta h (Jansen, Whiting & Hulbert 2000); when h changes, it is
// moved there (Bruels & Arnold 2008). Second order for gamma = 1/2 - theta.
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
  Accelerations past_;  // labelled by the ends of steps
  Vector a_;            // a0, moved to where this step needs it
  double last_h_ = 0;   // 0 after a restart
  Vector last_change_;  // next_.a - a_ of the last step
  Vector x_;            // M x = f in the step
};

}  // namespace orthodyn
