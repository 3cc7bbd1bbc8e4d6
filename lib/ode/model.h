// The seam between physics and integrators: M q'' = f(t, q, v), v = q'.
//
// Second-order form is the centre. With K = -df/dq and D = -df/dv on one pattern, every implicit
// scheme solves A = w_m M + w_d D + w_k K with its own three weights.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/core/pattern.h"
#include "lib/core/types.h"
#include "lib/ode/output.h"

namespace orthodyn {

struct Traits {
  bool linear = false;             // K and D do not depend on the state
  bool damped = false;             // stiffness-proportional in every region: fast vibrations die out soonest
  bool damping_matrix = false;     // D is more than a multiple of M
  bool lumped_mass = true;         // M is diagonal
  bool time_dependent = false;     // f depends on t
  bool conservative = true;        // total energy is constant when nothing is damped
  bool dissipative = false;        // power.dissipated can differ from zero
  bool loaded = false;             // power.loads can differ from zero
};

struct Weights {
  double mass = 0, damping = 0, stiffness = 0;
};

// K and D at one state: values on Model::pattern(). `damping` is empty when D is a multiple of M.
struct Linearization {
  std::vector<double> stiffness, damping;
};

// The force between two states. Of what has an energy U: f . (q1 - q0) = U(q0) - U(q1) to round-off, where U is
// invariant under rotation without a torque about (x0 + x1) / 2, and f -> -grad U as q1 -> q0.
class DiscreteGradient {
 public:
  virtual ~DiscreteGradient() = default;
  // Loads are taken at the middle of the times, forces that depend on velocities in the middle state with v. Throws
  // RecoverableError where it does not exist. N.
  virtual void mean_force(double t0, const ConstVectorRef& q0, double t1, const ConstVectorRef& q1,
                          const ConstVectorRef& v, VectorRef f) const = 0;
};

class Model : public OutputSource {
 public:
  virtual int num_dofs() const = 0;
  virtual const Traits& traits() const = 0;

  // f(t, q, v), N. Throws RecoverableError where it cannot be evaluated.
  virtual void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const = 0;

  // The pattern shared by M, D, K and A.
  virtual const Pattern& pattern() const = 0;

  virtual void linearize(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                         Linearization& out) const = 0;

  // Values of w_m M + w_d D + w_k K on pattern().
  virtual void combine(const Weights& w, const Linearization& at, double* values) const = 0;

  virtual void multiply_mass(const ConstVectorRef& x, VectorRef y) const = 0;
  // x <- M^-1 x
  virtual void solve_mass(VectorRef x) const = 0;

  // An upper bound of the largest angular frequency about rest, rad/s; 0 if there is none at hand.
  virtual double frequency_bound() const { return 0; }

  // Null if the model has none.
  virtual const DiscreteGradient* discrete_gradient() const { return nullptr; }

  // The parts that the force consists of, by name ("gravity"), and the model that has the same mass and only
  // some of them; this model must outlive it. Precondition: the names are among force_parts().
  virtual std::vector<std::string> force_parts() const { return {}; }
  virtual std::unique_ptr<Model> only(const std::vector<std::string>& parts) const;

  // Times in (start, end) where f is not smooth: multistep methods restart there. Ascending.
  virtual std::vector<double> breakpoints(double start, double end) const;
};

}  // namespace orthodyn
