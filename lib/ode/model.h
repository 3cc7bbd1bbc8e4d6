// The interface between physical models and integrators: M q'' = f(t, q, v), v = q', with n generalised positions q.
//
// The equation is in second-order form. With K = -df/dq and D = -df/dv on one pattern, every implicit scheme solves
// linear systems with A = w_m M + w_d D + w_k K and its own three weights.
//
// Units: q in m, v in m/s, f in N, M in kg, D in N s/m, K in N/m, t in s, for a mechanical model. Vectors have n
// entries. A matrix is stored as one value per entry of pattern().row.
//
// A model may be distributed over several MPI ranks. Each vector then holds the n unknowns of this rank; pattern() also
// has unknowns of other ranks, numbered after these. Functions are collective: all ranks call them in the same order,
// the result is that of the whole model, and a RecoverableError is thrown on all ranks. Sums and maxima over the
// entries of a vector go through space().
//
// Thread safety: const functions may run concurrently, each on its own outputs. A model does not change during an
// integration: the same arguments give the same results.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/pattern.h"
#include "lib/core/types.h"
#include "lib/ode/angles.h"
#include "lib/ode/output.h"
#include "lib/ode/step_limits.h"
#include "lib/ode/vector_space.h"

namespace orthodyn {

// Properties of a model that are known without any computation.
struct Traits {
  bool linear = false;          // K and D are constant: they depend neither on t nor on q or v
  bool damped = false;          // stiffness-proportional damping everywhere, so fast vibrations decay fastest
  bool damping_matrix = false;  // D is not just a multiple of M
  bool lumped_mass = true;      // M is diagonal
  bool time_dependent = false;  // f depends on t
  bool conservative = true;     // total energy is constant when nothing is damped
  bool dissipative = false;     // power.dissipated can differ from zero
  bool loaded = false;          // power.loads can differ from zero
  bool smooth = true;           // f has no kinks in q: there is no contact
  bool rigid = false;           // no body deforms: only springs, stops and contact could vibrate
  bool free = false;            // no point is held: only loads change the linear momentum
  bool exact_stiffness = true;  // K is -df/dq or its symmetric part, not an approximation
};

// The weights w_m, w_d and w_k of A.
struct Weights {
  double mass = 0, damping = 0, stiffness = 0;
};

// K and D at one state, from Model::linearize(). `damping` is empty when D is a multiple of M.
//
// An object may be passed to linearize() again for another state or model: it records the model whose constant K and D
// it holds. Precondition: the values are not changed in between.
struct Linearization {
  std::vector<double> stiffness, damping;

 private:
  friend class Model;
  std::uint64_t filled_by_ = 0;  // the number of the model whose constant K and D these are, or 0
};

// The mean force f between two states 0 and 1. If the force has an energy U, f . (q1 - q0) = U(q0) - U(q1) to
// round-off, and f -> -grad U as q1 -> q0. If U is also invariant under rotation, f has no torque about the mean nodal
// positions (x0 + x1) / 2.
// Source: Gonzalez (1996), Time integration and discrete Hamiltonian systems, J. Nonlinear Sci. 6.
class DiscreteGradient {
 public:
  virtual ~DiscreteGradient() = default;
  // Computes f in N. Loads are evaluated at the mean time. Forces that depend on velocities are evaluated at the mean
  // state with velocity v. Throws RecoverableError if the force does not exist.
  virtual void mean_force(double t0, const ConstVectorRef& q0, double t1, const ConstVectorRef& q1,
                          const ConstVectorRef& v, VectorRef f) const = 0;
};

class Constraints;        // lib/ode/constraints.h
class InternalVariables;  // lib/ode/internal_variables.h

class Model : public OutputSource {
 public:
  // The number n of unknowns of this rank.
  virtual int num_dofs() const = 0;

  // The ranks that hold the model, and their total number of unknowns; null and n for a model of one process.
  virtual const Ranks* ranks() const { return nullptr; }
  virtual Eigen::Index num_dofs_of_all() const { return num_dofs(); }
  VectorSpace space() const { return {ranks(), num_dofs_of_all()}; }
  // Returns this rank's part of a vector of all unknowns. `all` is numbered as in a model of one process.
  virtual Vector part_of(const Vector& all) const { return all; }

  virtual const Traits& traits() const = 0;

  // Computes f(t, q, v), N. Throws RecoverableError if f cannot be evaluated; a smaller step may help.
  virtual void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const = 0;

  // The model's internal variables, which live as long as the model; null if there are none. force(),
  // linearize() and linearize_predicted() assume that the internal variables are at equilibrium.
  virtual const InternalVariables* internal_variables() const { return nullptr; }

  // The algebraic constraints of the motion, which live as long as the model; null if there are none. The force and the
  // tangents of this interface do not contain the forces of the constraints.
  virtual const Constraints* constraints() const { return nullptr; }

  // The pattern shared by M, D, K and A. It does not change.
  virtual const Pattern& pattern() const = 0;

  // Computes K and D at a state. `kind`: the exact K, or its positive semidefinite Gauss-Newton part. Computes nothing
  // if traits().linear holds and `out` already has this model's K and D. Throws RecoverableError as force() does; `out`
  // may be passed again afterwards.
  void linearize(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                 Linearization& out) const;

  // Computes K at q with predicted stresses instead of the stresses at q: those at q_before plus their linear change
  // with q - q_before. This is the matrix of Newton's method with independent stress unknowns.
  //
  // The nodes of a bending body move on arcs, so a straight step stretches the body. Predicted stresses exclude the
  // stress of this stretch: K stays definite, and Newton's method converges, for far longer steps than with the exact
  // K. For q_before = q the result is the exact K. The default implementation always returns the exact K. `out` has no
  // damping. Throws as linearize() does.
  void linearize_predicted(double t_before, const ConstVectorRef& q_before, double t, const ConstVectorRef& q,
                           Linearization& out) const;

  // Computes values = w_m M + w_d D + w_k K. `at`: D and K from linearize() of this model.
  virtual void combine(const Weights& w, const Linearization& at, double* values) const = 0;

  // Computes y = A x for a matrix A with `values` on pattern(). x and y must be different vectors.
  virtual void multiply_matrix(const double* values, const ConstVectorRef& x, VectorRef y) const {
    pattern().multiply(values, x, y);
  }

  // Computes y = M x. x and y must be different vectors.
  virtual void multiply_mass(const ConstVectorRef& x, VectorRef y) const = 0;

  // Replaces x by M^-1 x. Throws RunError if M is not positive definite.
  virtual void solve_mass(VectorRef x) const = 0;

  // Rigid motions about q, as n x 6 displacements of arbitrary scale. K resists them least. Empty if the model has
  // none.
  virtual Eigen::MatrixXd rigid_motions(const ConstVectorRef& /*q*/) const { return {}; }

  // Upper bound of the largest angular frequency about rest, rad/s; 0 if unknown.
  virtual double frequency_bound() const { return 0; }

  // The model's discrete gradient, which lives as long as the model; null if there is none.
  virtual const DiscreteGradient* discrete_gradient() const { return nullptr; }

  // Names of the parts of the force, such as "gravity". only() makes a model with the same mass and the named parts;
  // this model must outlive it. Precondition: the names are among force_parts().
  virtual std::vector<std::string> force_parts() const { return {}; }
  virtual std::unique_ptr<Model> only(const std::vector<std::string>& parts) const;
  // The parts that are loads: in statics the load factor multiplies them (lib/statics/load_path.h). Empty optional if
  // unknown.
  virtual std::optional<std::vector<std::string>> load_parts() const { return std::nullopt; }

  // Times (s) in (start, end), ascending, at which f is not smooth. Integrators restart there.
  virtual std::vector<double> breakpoints(double start, double end) const;

  // Limits of adaptive steps between two times (s), so that no step misses a short change of f in time.
  virtual StepLimits step_limits(double /*start*/, double /*end*/) const { return {}; }

  // The longest step (s) from a state in which no body can pass through another one unseen, if no velocity grows to
  // more than four times the largest one; infinite without contact of bodies.
  virtual double longest_step(const State&) const { return std::numeric_limits<double>::infinity(); }

  // Angles of which State::angles count the turns; empty without any.
  virtual Angles angles(const State&) const { return {}; }

 private:
  // A number that is unique to this model; a copy of the model gets another number.
  class Number {
   public:
    Number();
    Number(const Number&) : Number() {}
    Number& operator=(const Number&) {
      value_ = Number().value_;
      return *this;
    }
    std::uint64_t value() const { return value_; }

   private:
    std::uint64_t value_;
  };

  // Computes K, and D if the model has one, and overwrites `out`. Called by linearize() unless `out` is up to date.
  virtual void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                        Linearization& out) const = 0;

  // Computes the K of linearize_predicted(), and overwrites `out`.
  virtual void assemble_predicted(double t_before, const ConstVectorRef& q_before, double t, const ConstVectorRef& q,
                                  Linearization& out) const;

  Number number_;
};

// The model without its loads; null if load_parts() is unknown. `model` must outlive the result.
std::unique_ptr<Model> without_loads(const Model& model);

}  // namespace orthodyn
