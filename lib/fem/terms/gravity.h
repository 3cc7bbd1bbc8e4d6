// Uniform gravity: f_i = m_i g, where m_i are the row sums of the mass matrix, so that free fall is uniform. The energy
// is -sum_i m_i g . u_i.
#pragma once

#include <fmt/format.h>

#include "lib/config/values.h"
#include "lib/fem/term_choice.h"

namespace orthodyn {

class Gravity : public Term {
 public:
  // `nodal_masses` (kg) must outlive the term. `mass`: mass of the whole body, kg.
  Gravity(const Vec3& g, const Vector& nodal_masses, double mass) : g_(g), masses_(nodal_masses), mass_(mass) {}

  std::string name() const override { return "gravity"; }
  std::string description() const override {
    return fmt::format("gravity: {} m/s^2 on {:.6g} kg", Value<Vec3>::yaml(g_), mass_);
  }
  // The copy is enough: the nodal masses already belong to this rank.
  std::unique_ptr<Term> part(const Subdomain&) const override { return std::make_unique<Gravity>(*this); }
  bool is_dead() const override { return true; }
  void add_force(const NodalState&, NodalVector& f) const override { f += g_ * masses_.transpose(); }
  EnergyKind energy_kind() const override { return EnergyKind::gravitational; }
  double energy(const NodalState& s) const override { return -g_.dot(s.u * masses_); }

 private:
  Vec3 g_;
  const Vector& masses_;
  double mass_;
};

// The key `gravity` of a scene: three numbers, m/s^2.
struct GravityChoice : TermChoice {
  Vec3 g = Vec3::Zero();

  std::unique_ptr<Term> make(const Discretization& body) const override {
    return std::make_unique<Gravity>(g, body.nodal_masses, body.mass);
  }
};

template <>
struct Value<GravityChoice> {
  static ValueSchema schema() { return Value<Vec3>::schema(); }
  static GravityChoice read(const Config& c, const Rule& r) {
    GravityChoice gravity;
    gravity.g = Value<Vec3>::read(c, r);
    return gravity;
  }
  static std::string yaml(const GravityChoice& gravity) { return Value<Vec3>::yaml(gravity.g); }
};

}  // namespace orthodyn
