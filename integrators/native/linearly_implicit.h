// What linearly implicit methods share: no Newton iteration, only solves with I - gamma J of y' = (v, M^-1 f), whose
// A = M + gamma D + gamma^2 K is factored at the beginning of a step (reduced_solve.h).
#pragma once

#include "integrators/native/one_step.h"
#include "integrators/reduced_solve.h"

namespace orthodyn {

class LinearlyImplicit : public OneStep {
 public:
  // K and D are kept for `tangent_steps` steps, or until one fails. Throws ConfigError if the linear solver does
  // not take the model's matrices.
  LinearlyImplicit(const std::string& name, const Model& model, const LinearOptions& options, const Scales& scales,
                   int tangent_steps);
  std::size_t factor_bytes() const override { return solve_.factor_bytes(); }

 protected:
  void restarted() override;
  void accepted(double h) override;
  std::string solver_description() const override { return solve_.description(); }
  std::size_t method_bytes() const override;

  // The factor for a step that is about to be attempted. False if there is none.
  bool prepare(double gamma);
  // next_'s q and v stand: the force there, which the next step begins with. The acceleration for dense output is the
  // method's own, for M^-1 f would multiply what the step left of stiff modes by their stiffness.
  void finish(const ConstVectorRef& a);

  const Vector& force_now() const { return f_now_; }    // at now()
  const Vector& force_next() const { return f_next_; }  // at next_, after finish()
  ReducedSolve solve_;

 private:
  int tangent_steps_;
  int age_ = 0;  // steps that K and D have served; 0: not one
  bool linearized_ = false;
  bool attempted_ = false;  // a step from now() was tried before
  double gamma_ = 0;        // of the factor; 0 if there is none
  Vector f_now_, f_next_;
};

}  // namespace orthodyn
