#include "lib/fem/mean_force.h"

namespace orthodyn {

namespace {

void add_mean_forces(const FemModel::Parts& parts, const NodalState& begin, const NodalState& end, NodalVector& sum) {
  for (const auto& term : parts.elastic) term->add_mean_force(begin, end, sum);
  for (const auto& term : parts.loads) term->add_mean_force(begin, end, sum);
}

// What the terms exert in motion less what they exert at rest.
void add_damping(const FemModel::Parts& parts, const NodalState& moving, NodalVector& sum) {
  const NodalVector still = NodalVector::Zero(3, moving.x.cols());
  NodalVector without = NodalVector::Zero(3, moving.x.cols());
  const auto add = [&](const Term& term) {
    term.add_force(moving, sum);
    term.add_force({moving.t, moving.x, moving.u, still}, without);
  };
  for (const auto& term : parts.elastic) add(*term);
  for (const auto& term : parts.loads) add(*term);
  sum -= without;
}

}  // namespace

void MeanForce::mean_force(double t0, const ConstVectorRef& q0, double t1, const ConstVectorRef& q1,
                           const ConstVectorRef& v, VectorRef f) const {
  const Vector still = Vector::Zero(q0.size());
  const NodalExpansion begin(parts_, t0, q0, still), end(parts_, t1, q1, still);
  NodalVector sum = NodalVector::Zero(3, begin.x.cols());
  add_mean_forces(parts_, begin.state(), end.state(), sum);
  if (parts_.traits.damping_matrix) {
    const double t = 0.5 * (t0 + t1);
    const NodalVector x = 0.5 * (begin.x + end.x), u = 0.5 * (begin.u + end.u);
    const NodalVector rate = NodalExpansion(parts_, t, q0, v).u_rate;
    add_damping(parts_, {t, x, u, rate}, sum);
  }
  parts_.dofs->restrict_to(sum, f);
  if (parts_.mass_damping == 0) return;
  Vector momentum(v.size());
  parts_.mass->multiply(v, momentum);
  f -= parts_.mass_damping * momentum;
}

}  // namespace orthodyn
