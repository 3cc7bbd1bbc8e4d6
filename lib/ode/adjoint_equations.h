// The adjoint equations of a motion: the derivatives of one number G with respect to many parameters p of the model,
// for the cost of one more integration backward in time, whatever the number of parameters. Its steps may be shorter
// than those of the motion: a source at one point also shakes stiff modes, which last if there is no damping.
//
// With M q'' = f(t, q, v, p), K = -df/dq and D = -df/dv, and G = sum over k of g_k(q(t_k), v(t_k)), the adjoint state
// (a, b) obeys, backward in time,
//
//     a' = K^T b,   M b' = D^T b - a,
//
// starts from 0 after the last t_k, and jumps at each t_k: a grows by dg_k/dq, and M b by dg_k/dv. Then
//
//     dG/dp = integral of b . (df/dp - dM/dp q'') dt + a . dq_0/dp + M b . dv_0/dp   at the start.
//
// Source: Cao, Li, Petzold & Serban (2003), SIAM J. Sci. Comput. 24, 1076-1089, for the form y' = F(t, y, p), with
// (a, M b) as the adjoint of (q, v).
#pragma once

#include <optional>
#include <vector>

#include "lib/ode/integrator.h"

namespace orthodyn {

class AdjointEquations {
 public:
  virtual ~AdjointEquations() = default;

  // The times t_k, ascending, after the start.
  virtual const std::vector<double>& times() const = 0;

  // dg_k/dq and dg_k/dv at the state at t_k.
  virtual void source(std::size_t k, const State& state, VectorRef by_position, VectorRef by_velocity) = 0;

  // The number of parameters.
  virtual int count() const = 0;

  // A change of parameter i, for error control: the error of the change of G that follows from it is relative to
  // size().
  virtual double scale(int i) const = 0;

  // The size of G, if it is no position or velocity; default that of the motion. Called after source().
  virtual std::optional<double> size() const { return std::nullopt; }

  // Computes b . (df/dp - dM/dp q'') for each parameter at a state of the motion. Throws RecoverableError as
  // Model::force() does.
  virtual void products(const State& state, const ConstVectorRef& b, VectorRef out) = 0;

  // Called after each step of the motion with the time reached, s.
  virtual void on_forward_step(double /*t*/) {}
};

struct AdjointSolution {
  Vector integral;     // of the products, by parameter
  Vector a, momentum;  // a and M b at the start
  long forward_steps = 0, backward_steps = 0;
  double rtol = 0;  // of the adjoint equations
};

// A method whose choice also integrates adjoint equations derives from this class beside IntegratorChoice.
class AdjointIntegrator {
 public:
  virtual ~AdjointIntegrator() = default;

  // Integrates the motion of the task forward to the last of the times, and the adjoint equations backward to its
  // start. Preconditions: the model is smooth, K and D are symmetric and the model's exact tangents. Throws RunError.
  virtual AdjointSolution integrate_adjoint(const Model& model, const Task& task,
                                            AdjointEquations& equations) const = 0;
};

}  // namespace orthodyn
