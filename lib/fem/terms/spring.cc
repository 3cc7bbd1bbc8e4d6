#include "lib/fem/terms/spring.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

// l0/l; 0 for a rest length of zero.
double contraction(const SpringLink& link, double length) {
  if (link.rest_length == 0) return 0;
  if (!(length > 0)) throw RecoverableError("a spring has shrunk to a point and has no direction");
  return link.rest_length / length;
}

}  // namespace

std::string Springs::description() const {
  return fmt::format("{}: {} of {:.6g} N/m", name(), links_.size(), k_);
}

void Springs::add_force(const NodalState& s, NodalVector& f) const {
  for (const SpringLink& link : links_) {
    const Vec3 d = link.span(s.x);
    link.add_force(-k_ * (1 - contraction(link, d.norm())) * d, f);
  }
}

void Springs::add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const {
  for (const SpringLink& link : links_) {
    const Vec3 d0 = link.span(s0.x), d1 = link.span(s1.x);
    link.add_force(-k_ / 2 * (1 - contraction(link, (d0.norm() + d1.norm()) / 2)) * (d0 + d1), f);
  }
}

void Springs::add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double*) const {
  for (const SpringLink& link : links_) {
    const Vec3 d = link.span(s.x);
    const double c = contraction(link, d.norm());
    double across = 1 - c;  // negative under compression
    if (kind == TangentKind::gauss_newton) across = std::max(across, 0.0);
    Mat3 block = across * Mat3::Identity();
    if (c > 0) block += (1 - across) / d.squaredNorm() * d * d.transpose();
    link.add_block(k_ * block, pattern_, stiffness);
  }
}

double Springs::energy(const NodalState& s) const {
  double sum = 0;
  for (const SpringLink& link : links_) {
    const double stretch = link.span(s.x).norm() - link.rest_length;
    sum += 0.5 * k_ * stretch * stretch;
  }
  return sum;
}

void Springs::add_stiffness_bound(Vector& row_sums) const {
  for (const SpringLink& link : links_) link.add_row_sum(k_, row_sums);
}

}  // namespace orthodyn
