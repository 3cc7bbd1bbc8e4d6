#include "lib/fem/terms/dashpot.h"

#include <fmt/format.h>

#include "lib/core/errors.h"

namespace orthodyn {

std::string Dashpots::description() const {
  return fmt::format("{}: {} of {:.6g} N s/m", name(), links_.size(), c_);
}

Mat3 Dashpots::matrix(const Link& link, const NodalVector& x) const {
  if (law_ == DashpotLaw::all_directions) return c_ * Mat3::Identity();
  const Vec3 d = link.span(x);
  if (!(d.norm() > 0)) throw RecoverableError("a dashpot has shrunk to a point and has no direction");
  const Vec3 n = d.normalized();
  return c_ * n * n.transpose();
}

void Dashpots::add_force(const NodalState& s, NodalVector& f) const {
  for (const Link& link : links_) link.add_force(-matrix(link, s.x) * link.rate(s.v), f);
}

void Dashpots::add_tangent(const NodalState& s, TangentKind, double*, double* damping) const {
  if (!damping) return;
  for (const Link& link : links_) link.add_block(matrix(link, s.x), pattern_, damping);
}

double Dashpots::dissipation(const NodalState& s) const {
  double sum = 0;
  for (const Link& link : links_) {
    const Vec3 rate = link.rate(s.v);
    sum += rate.dot(matrix(link, s.x) * rate);
  }
  return sum;
}

}  // namespace orthodyn
