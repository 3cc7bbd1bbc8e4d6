// Smoothed Coulomb friction of a contact: against the sliding velocity w (m/s), the part of the relative velocity
// across the normal n, acts the force mu N w / sqrt(w^2 + c^2), with the coefficient mu, the normal force N and the
// creep velocity c. Bodies that stick creep, by a fraction of c. Forces and their derivatives by velocity only: they
// dissipate.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "lib/config/spec.h"
#include "lib/core/types.h"
#include "lib/ode/model.h"

namespace orthodyn {

struct Friction {
  double coefficient = 0;  // 0: none
  double creep = 1e-3;     // m/s

  bool acts() const { return coefficient > 0; }

  // N. `velocity`: of the pressed point relative to the other body, m/s; `normal` force in N.
  Vec3 force(const Vec3& velocity, const Vec3& n, double normal) const {
    const Vec3 w = velocity - n * n.dot(velocity);
    return -coefficient * normal / std::sqrt(w.squaredNorm() + creep * creep) * w;
  }

  // -dforce/dvelocity, N s/m: symmetric and positive semidefinite.
  Mat3 damping(const Vec3& velocity, const Vec3& n, double normal) const {
    const Mat3 P = Mat3::Identity() - n * n.transpose();
    const Vec3 w = P * velocity;
    const double s = w.squaredNorm() + creep * creep;
    return coefficient * normal / std::sqrt(s) * (P - w * w.transpose() / s);
  }

  void declare(Traits& traits) const {
    if (!acts()) return;
    traits.damping_matrix = traits.dissipative = true;
    traits.conservative = false;
  }
};

// The keys `friction`, `creep` and `name` of a contact.
template <class C>
Spec<C> with_contact_keys(Spec<C> spec, double C::*coefficient, double C::*creep, std::string C::*name) {
  return std::move(spec)
      .key("friction", coefficient, "Coefficient of friction; 0: none. It acts against velocities, not in statics.",
           {.range = {.low = 0}})
      .key("creep", creep,
           "Sliding velocity at which friction reaches 0.7 of its limit. Bodies that stick creep by a fraction of it.",
           {.unit = "m/s", .range = kPositive})
      .key("name", name, "Name of its outputs, such as contact.NAME; default contact_1, contact_2 and so on.");
}

}  // namespace orthodyn
