#include "lib/fem/terms/pressure.h"

#include "lib/element/axial.h"

namespace orthodyn {

namespace {

Vec3 area_vector(const NodalVector& x, const Triangle& t) {
  const Vec3 base = x.col(t[0]);
  return 0.5 * (x.col(t[1]) - base).cross(x.col(t[2]) - base);
}

// [opposite side of node b]: 2 da/dx_b.
Mat3 area_gradient(const NodalVector& x, const Triangle& t, std::size_t b) {
  return cross_matrix<double>(x.col(t[(b + 2) % 3]) - x.col(t[(b + 1) % 3]));
}

}  // namespace

Vec3 PressedTriangle::force(const NodalVector& x, std::size_t i) const {
  return -pressures[static_cast<Eigen::Index>(i)] * area_vector(x, nodes);
}

Pressure::Pressure(std::string surface, std::vector<PressedTriangle> triangles,
                   std::shared_ptr<const TimeFunction> factor, const BlockPattern& pattern)
    : surface_(std::move(surface)), triangles_(std::move(triangles)), factor_(std::move(factor)), pattern_(pattern) {}

void Pressure::add_force_of(double factor, const NodalVector& x, NodalVector& f) const {
  for (const PressedTriangle& t : triangles_) {
    const Vec3 push = -factor * area_vector(x, t.nodes);
    for (std::size_t i = 0; i < 3; ++i) f.col(t.nodes[i]) += t.pressures[static_cast<Eigen::Index>(i)] * push;
  }
}

void Pressure::add_force(const NodalState& s, NodalVector& f) const { add_force_of(factor_->value(s.t), s.x, f); }

void Pressure::add_peak_force(const NodalState& s, double end, NodalVector& f) const {
  add_force_of(factor_->peak(s.t, end), s.x, f);
}

void Pressure::add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double*) const {
  if (kind == TangentKind::gauss_newton) return;  // indefinite
  const double factor = factor_->value(s.t);
  for (const auto& [t, pressures] : triangles_) {
    const Vec3 half = factor / 2 * pressures;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        if (pattern_.symmetric() && t[a] <= t[b]) continue;  // the diagonal's symmetric part is zero
        Mat3 block = half[static_cast<Eigen::Index>(a)] * area_gradient(s.x, t, b);
        if (pattern_.symmetric())
          block = 0.5 * (block - half[static_cast<Eigen::Index>(b)] * area_gradient(s.x, t, a));
        pattern_.add(t[a], t[b], pattern_.offset(t[a], t[b]), block, stiffness);
      }
  }
}

double Pressure::load_power(const NodalState& s) const {
  double power = 0;  // at factor 1
  for (const PressedTriangle& t : triangles_) {
    Mat3 v;
    for (std::size_t i = 0; i < 3; ++i) v.col(static_cast<Eigen::Index>(i)) = s.v.col(t.nodes[i]);
    power -= area_vector(s.x, t.nodes).dot(v * t.pressures);
  }
  return factor_->value(s.t) * power;
}

std::vector<double> Pressure::breakpoints(double start, double end) const {
  return times_between(factor_->kinks(), start, end);
}

}  // namespace orthodyn
