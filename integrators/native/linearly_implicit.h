// Base of the linearly implicit methods, which need no Newton iteration. They solve linear systems with I - gamma J,
// where gamma is in s and J is the Jacobian of y' = (v, M^-1 f). The matrix A = M + gamma D + gamma^2 K is factored at
// the start of a step (reduced_solve.h) if gamma, K or D has changed.
#pragma once

#include "integrators/native/one_step.h"
#include "integrators/reduced_solve.h"

namespace orthodyn {

class LinearlyImplicit : public OneStep {
 public:
  // K and D of a nonlinear model are kept for `tangent_steps` steps, or until a step fails. Throws ConfigError if the
  // linear solver does not accept the model's matrices.
  LinearlyImplicit(const std::string& name, const Model& model, const LinearOptions& options, const Scales& scales,
                   int tangent_steps);
  std::size_t factor_bytes() const override { return solve_.factor_bytes(); }

 protected:
  void restarted() override;
  void accepted(double h) override;
  std::string solver_description() const override { return solve_.description(); }
  std::size_t method_bytes() const override;

  // Updates K, D and the factor of A if needed; call it at the start of attempt(). False if A is singular or
  // indefinite.
  bool prepare(double gamma);
  // Evaluates the force at next_, for the start of the next step; call it once q and v of next_ are known. `a`: the
  // method's own acceleration (m/s^2) for dense output, because M^-1 f would multiply the error of stiff modes by their
  // stiffness.
  void finish(const ConstVectorRef& a);

  const Vector& force_now() const { return f_now_; }    // force at now()
  const Vector& force_next() const { return f_next_; }  // force at next_, after finish()
  ReducedSolve solve_;

 private:
  int tangent_steps_;
  int age_ = 0;  // number of steps taken with the current K and D
  bool linearized_ = false;
  bool attempted_ = false;  // a step from now() has been tried
  double gamma_ = 0;        // s, of the current factor; 0 without a factor
  Vector f_now_, f_next_;
};

}  // namespace orthodyn
