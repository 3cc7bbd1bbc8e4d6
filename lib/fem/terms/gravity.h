// Uniform gravity: f_i = m_i g, energy - sum m_i g . (x_i - X_i).
#pragma once

#include "lib/fem/term.h"

namespace orthodyn {

class Gravity : public Term {
 public:
  // nodal_masses in kg; rest positions in m; both must outlive the term.
  Gravity(const Vec3& g, const Vector& nodal_masses, const NodalVector& rest)
      : g_(g), masses_(nodal_masses), rest_(rest) {}

  std::string name() const override { return "gravity"; }
  void add_force(const NodalState&, NodalVector& f) const override { f += g_ * masses_.transpose(); }
  EnergyKind energy_kind() const override { return EnergyKind::gravitational; }
  double energy(const NodalState& s) const override { return -g_.dot((s.x - rest_) * masses_); }

 private:
  Vec3 g_;
  const Vector& masses_;
  const NodalVector& rest_;
};

}  // namespace orthodyn
