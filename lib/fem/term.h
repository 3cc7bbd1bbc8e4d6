// A contribution to the force f in M u'' = f. Each physical effect has its own file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/core/types.h"
#include "lib/fem/dof_map.h"
#include "lib/fem/subdomain.h"
#include "lib/ode/internal_variables.h"
#include "lib/ode/step_limits.h"

namespace orthodyn {

class Contact;

// Positions, displacements and velocities of all nodes, clamped ones included. Compute quantities that vanish at rest
// from u, not from x - X, which loses the digits of small displacements.
struct NodalState {
  double t;                                 // s
  const NodalVector& x;                     // positions, m: rest positions X plus u
  const NodalVector& u;                     // m
  const NodalVector& v;                     // m/s
  double load_factor = 1;                   // of statics: energies and stresses belong to the loads times this factor
  const InternalState* internal = nullptr;  // null: internal variables at equilibrium
};

enum class EnergyKind { none, elastic, gravitational };

class Term {
 public:
  virtual ~Term() = default;

  // Kind and location, such as "gravity" or "traction on x1". part_names() uses it for this part of the force.
  virtual std::string name() const = 0;

  // Name with number and size for `orthodyn check`, such as "springs: 4 of 200 N/m".
  virtual std::string description() const { return name(); }
  virtual std::size_t bytes() const { return 0; }

  // The contribution of one rank, in the node numbering of that rank; the contributions of all ranks add up to this
  // term. Null if the term does not support several ranks.
  virtual std::unique_ptr<Term> part(const Subdomain&) const { return nullptr; }

  virtual void add_force(const NodalState& s, NodalVector& f) const = 0;

  // Whether the load factor of statics and buckling multiplies the force. False for parts of the structure, such as
  // springs, which always act in full.
  virtual bool is_load() const { return energy_kind() != EnergyKind::elastic; }

  // Whether the force depends on neither positions nor velocities, so that the term has no tangent.
  virtual bool is_dead() const { return false; }

  // Adds the force on the body in state s with the largest magnitude of the time function from s.t to `end` (s).
  virtual void add_peak_force(const NodalState& s, double /*end*/, NodalVector& f) const { add_force(s, f); }

  // Equivalent duration (s): the impulse from `start` to `end` divided by the peak force.
  virtual double seconds_at_peak(double start, double end) const { return end - start; }

  // False for forces of an energy without a mean force.
  virtual bool has_mean_force() const { return true; }

  // Adds the mean force between two states (DiscreteGradient in lib/ode/model.h). Default: the static force at the
  // midpoint, exact for energies that are at most quadratic.
  virtual void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const {
    const NodalVector x = 0.5 * (s0.x + s1.x), u = 0.5 * (s0.u + s1.u), still = NodalVector::Zero(3, x.cols());
    add_force({0.5 * (s0.t + s1.t), x, u, still}, f);
  }

  // Adds -df/dx to `stiffness` and -df/dv to `damping` (null if the model has no D).
  virtual void add_tangent(const NodalState&, TangentKind, double* /*stiffness*/, double* /*damping*/) const {}

  // Adds -df/dx as defined by Model::linearize_predicted().
  virtual void add_predicted_tangent(const NodalState& /*before*/, const NodalState& s, double* stiffness) const {
    add_tangent(s, TangentKind::exact, stiffness, nullptr);
  }

  // Adds an upper bound of each node's stiffness row sum (N/m). Elasticity uses another bound:
  // ElasticTerm::max_frequency_squared().
  virtual void add_stiffness_bound(Vector& /*row_sums*/) const {}

  virtual const Contact* contact() const { return nullptr; }  // null for terms without contact

  virtual EnergyKind energy_kind() const { return EnergyKind::none; }
  virtual double energy(const NodalState&) const { return 0; }       // J
  virtual double dissipation(const NodalState&) const { return 0; }  // W, >= 0
  virtual double load_power(const NodalState&) const { return 0; }   // W

  virtual std::vector<double> breakpoints(double /*start*/, double /*end*/) const { return {}; }
  virtual StepLimits step_limits(double /*start*/, double /*end*/) const { return {}; }
};

}  // namespace orthodyn
