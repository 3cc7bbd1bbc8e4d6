// A contribution to the right-hand side of M u'' = f: one physical effect per file. A scene holds
// the terms that it names and nothing else.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/core/types.h"
#include "lib/fem/dof_map.h"
#include "lib/fem/subdomain.h"
#include "lib/ode/step_limits.h"

namespace orthodyn {

// Positions, displacements and velocities of all nodes, clamped ones included. What vanishes at rest is to be computed
// from u: the digits that x has of a small displacement are few.
struct NodalState {
  double t;              // s
  const NodalVector& x;  // m; the rest position plus u
  const NodalVector& u;  // m
  const NodalVector& v;  // m/s
};

enum class EnergyKind { none, elastic, gravitational };

class Term {
 public:
  virtual ~Term() = default;

  // Kind and place of the term: "gravity", "traction on x1". Names this part of the force (part_model.h).
  virtual std::string name() const = 0;

  // Name with number and size, for `orthodyn check`: "springs: 4 of 200 N/m".
  virtual std::string description() const { return name(); }
  virtual std::size_t bytes() const { return 0; }

  // The part of this term that one rank adds, in that rank's numbering of nodes. The parts of all ranks add up to this
  // term. Null if the term cannot be divided.
  virtual std::unique_ptr<Term> part(const Subdomain&) const { return nullptr; }

  virtual void add_force(const NodalState& s, NodalVector& f) const = 0;

  // Whether it loads the body, so that a load factor of statics and buckling multiplies its force. Else it is a part of
  // the structure, as springs are: it acts in full from the start.
  virtual bool is_load() const { return energy_kind() != EnergyKind::elastic; }

  // Whether its force depends on time alone, neither on positions nor on velocities; then it adds no tangent.
  virtual bool is_dead() const { return false; }

  // Adds the force at the time in [s.t, end] at which the time function is largest, on the body in state s. `end`: s.
  virtual void add_peak_force(const NodalState& s, double /*end*/, NodalVector& f) const { add_force(s, f); }

  // Equivalent duration (s): the impulse from `start` to `end` divided by the peak force.
  virtual double seconds_at_peak(double start, double end) const { return end - start; }

  // The force between two states (DiscreteGradient in lib/ode/model.h): by default that of the middle, at rest,
  // which is exact where the energy is at most quadratic.
  virtual void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const {
    const NodalVector x = 0.5 * (s0.x + s1.x), u = 0.5 * (s0.u + s1.u), still = NodalVector::Zero(3, x.cols());
    add_force({0.5 * (s0.t + s1.t), x, u, still}, f);
  }

  // Adds -df/dx to `stiffness` and -df/dv to `damping` (null if the model has no D).
  virtual void add_tangent(const NodalState&, TangentKind, double* /*stiffness*/, double* /*damping*/) const {}

  // Adds -df/dx as Model::linearize_mixed() has it.
  virtual void add_mixed_tangent(const NodalState& /*before*/, const NodalState& s, double* stiffness) const {
    add_tangent(s, TangentKind::exact, stiffness, nullptr);
  }

  // Adds to each node an upper bound of the row sums of its stiffness, N/m; elasticity has its own bound.
  virtual void add_stiffness_bound(Vector& /*row_sums*/) const {}

  // Contact stiffness of the stiffest node, N/m; 0 for terms without contact.
  virtual double contact_stiffness() const { return 0; }

  virtual EnergyKind energy_kind() const { return EnergyKind::none; }
  virtual double energy(const NodalState&) const { return 0; }       // J
  virtual double dissipation(const NodalState&) const { return 0; }  // W, >= 0
  virtual double load_power(const NodalState&) const { return 0; }   // W

  virtual std::vector<double> breakpoints(double /*start*/, double /*end*/) const { return {}; }
  virtual StepLimits step_limits(double /*start*/, double /*end*/) const { return {}; }
};

}  // namespace orthodyn
