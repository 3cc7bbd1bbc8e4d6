// First-order unknowns z of a model beside its positions, such as viscoelastic strains:
//     M q'' = f(t, q, v, z),   z_i' = (e_i(t, q) - z_i) / tau_i
// with strains e and relaxation times tau. At fixed t and q, f is linear in z. The strains e of bodies that swell are
// those without the stress-free strain, which depends on t.
//
// Thread safety as for Model. z is dimensionless for a mechanical model. Strain vectors have size() entries.
#pragma once

#include <cmath>

#include "lib/core/types.h"

namespace orthodyn {

struct Linearization;

// Values of the internal variables, as a function of the strains e: z_i = values_i + share(tau_i) e_i.
struct InternalState {
  // given: z is known. relaxed: z = e, its equilibrium. history: z at the end of an interval, over which e changes at a
  // constant rate; `values` then has the part of z that is known at the start (advance_of_history()).
  // branch: z = e for the relaxation time `time`, z = 0 for the others.
  // change: z is a change of the variables, for the change of the force.
  enum class Kind { given, relaxed, history, branch, change };
  Kind kind = Kind::relaxed;
  const double* values = nullptr;  // null for zero
  // s. history: the length of the interval. given: the gamma of Newton's method (integrators/reduced_solve.h); K then
  // contains the change of z with q that an implicit step of this gamma has.
  double time = 0;

  // The factor of e in z, for forces and energies: 0 if z is given.
  double share(double tau) const { return kind == Kind::given || kind == Kind::change ? 0 : tangent_share(tau); }
  // The derivative of z with respect to e, for tangents.
  double tangent_share(double tau) const {
    if (kind == Kind::relaxed) return 1;
    if (kind == Kind::branch) return tau == time ? 1 : 0;
    const double x = time / tau;
    if (kind == Kind::given) return x / (1 + x);
    return x < 1e-5 ? x / 2 - x * x / 6 : 1 + std::expm1(-x) / x;
  }
};

class InternalVariables {
 public:
  virtual ~InternalVariables() = default;
  virtual Eigen::Index size() const = 0;
  virtual const Vector& relaxation_times() const = 0;  // tau, s
  // The typical strain of a body whose positions change by `position` (m).
  virtual double strain_of(double position) const = 0;

  // Model::force() and linearize() with these internal variables.
  virtual void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, const InternalState& z,
                     VectorRef f) const = 0;
  virtual void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, const InternalState& z,
                        TangentKind kind, Linearization& out) const = 0;

  // Adds the force (N) by which stress-free strains act on the body at rest through its internal variables: for the
  // peak of these strains from `start` to `end` (s), and a body whose strain grows during this time. The loads of the
  // model have the other part of the force of these strains.
  virtual void add_peak_force(double start, double end, VectorRef f) const = 0;

  // e, and its derivative de/dq dq.
  virtual void strains(double t, const ConstVectorRef& q, VectorRef e) const = 0;
  // The strains with the stress-free strain: z of a body that has rested in the shape q before it swells.
  virtual void total_strains(double t, const ConstVectorRef& q, VectorRef e) const = 0;
  virtual void strain_change(double t, const ConstVectorRef& q, const ConstVectorRef& dq, VectorRef de) const = 0;
  // df/dz dz, N.
  virtual void force_change(double t, const ConstVectorRef& q, const Vector& dz, VectorRef df) const = 0;
};

// The internal variables after `h` seconds in which the strains change from e0 to e1 at a constant rate, without the
// part share(tau) e1 (InternalState::Kind::history). Exact.
// Source: Taylor, Pister & Goudreau, IJNME 2, 1970; Simo & Hughes, Computational Inelasticity, 1998, section 10.3.
inline Vector advance_of_history(const InternalVariables& internal, const Vector& z0, const Vector& e0, double h) {
  const InternalState after{InternalState::Kind::history, nullptr, h};
  const Vector& tau = internal.relaxation_times();
  Vector z(z0.size());
  double known = 0, of_e0 = 0, decay = 0;  // equal times follow each other
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    if (tau[i] != known) {
      known = tau[i];
      of_e0 = 1 - after.tangent_share(known);
      decay = std::exp(-h / known);
    }
    z[i] = of_e0 * e0[i] - decay * (e0[i] - z0[i]);
  }
  return z;
}

}  // namespace orthodyn
