// The seam between physics and integrators: M q'' = f(t, q, v), v = q'.
//
// Second-order form is the centre. With K = -df/dq and D = -df/dv on one pattern, every implicit
// scheme solves A = w_m M + w_d D + w_k K with its own three weights.
#pragma once

#include <string>
#include <vector>

#include "lib/core/pattern.h"
#include "lib/core/types.h"
#include "lib/ode/output.h"

namespace orthodyn {

struct Traits {
  bool linear = false;             // K and D do not depend on the state
  bool damped = false;             // stiffness-proportional damping everywhere: orders above 2 pay
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

  // Times in (start, end) where f is not smooth: multistep methods restart there. Ascending.
  virtual std::vector<double> breakpoints(double start, double end) const;
};

}  // namespace orthodyn
