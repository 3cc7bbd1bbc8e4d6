#include "lib/analysis/strain_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lib/element/corotational_law.h"

namespace orthodyn {

namespace {

// The plane of axes i and j under uniaxial stress along i, with E_i, nu_ij and mu_ij.
struct Plane {
  int j;
  double young, nu, mu;
};

// The body has collapsed below this strain. (For isotropic materials all conditions have a double root at -1.)
constexpr double kCollapse = -0.99;

// Keeps the candidate if it is closer to zero strain than the present limit.
void tighten(AxisLimits& limits, const StrainLimit& candidate) {
  auto& side = candidate.strain < 0 ? limits.compression : limits.tension;
  if (candidate.strain <= kCollapse) return;
  if (!side || std::abs(candidate.strain) < std::abs(side->strain)) side = candidate;
}

// Solves 4 mu (1 - nu e)^2 + E e (3 + (1 - 2 nu) e) = 0 for the strain e.
void add_kink(const Plane& p, AxisLimits& limits) {
  const double a = 4 * p.mu * p.nu * p.nu + p.young * (1 - 2 * p.nu);
  const double b = 3 * p.young - 8 * p.mu * p.nu;
  const double c = 4 * p.mu;
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  if (q != 0) tighten(limits, {c / q, LimitKind::kink, p.j});
  if (a != 0) tighten(limits, {q / a, LimitKind::kink, p.j});
}

void add_slide(const Plane& p, AxisLimits& limits) {
  if (p.young > 4 * p.mu) tighten(limits, {4 * p.mu / (p.young - 4 * p.mu), LimitKind::slide, p.j});
}

void add_flattening(const Plane& p, AxisLimits& limits) {
  if (p.nu != 0) tighten(limits, {1 / p.nu, LimitKind::flat, p.j});
}

// Inverse of C. C is scaled to unit diagonal because the moduli may differ by decades.
Mat6 compliance(const Mat6& C) {
  const Vec6 scale = C.diagonal().cwiseSqrt().cwiseInverse();
  const Mat6 unit = scale.asDiagonal() * C * scale.asDiagonal();
  return scale.asDiagonal() * unit.inverse() * scale.asDiagonal();
}

std::array<AxisLimits, 3> orthotropic_limits(const Mat6& S) {
  constexpr int shear[3][3] = {{-1, 3, 5}, {3, -1, 4}, {5, 4, -1}};
  std::array<AxisLimits, 3> out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      const Plane plane{j, 1 / S(i, i), -S(i, j) / S(i, i), 1 / S(shear[i][j], shear[i][j])};
      AxisLimits& limits = out[static_cast<std::size_t>(i)];
      add_kink(plane, limits);
      add_slide(plane, limits);
      add_flattening(plane, limits);
    }
  return out;
}

// Strain tensor under uniaxial stress along the axis, scaled to unit strain along the axis.
Mat3 uniaxial_strain(const Mat6& S, int axis) {
  const Vec6 e = S.col(axis) / S(axis, axis);
  return (Mat3() << e[0], e[3] / 2, e[5] / 2, e[3] / 2, e[1], e[4] / 2, e[5] / 2, e[4] / 2, e[2]).finished();
}

// The strain closest to zero, between 0 and `end`, at which the law fails; nullopt if the law holds up to `end`.
template <class Holds>
std::optional<double> first_failure(const Holds& holds, double end) {
  constexpr int kSteps = 50, kBisections = 10;
  double good = 0;
  for (int k = 1; k <= kSteps; ++k) {
    double bad = end * k / kSteps;
    if (holds(bad)) {
      good = bad;
      continue;
    }
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (good + bad);
      (holds(middle) ? good : bad) = middle;
    }
    return bad;
  }
  return std::nullopt;
}

// Directions on a half sphere, about 7 degrees apart, the coordinate axes included.
std::vector<Vec3> half_sphere() {
  constexpr int kSteps = 12;  // from the pole, axis 1, to the equator
  constexpr double kRightAngle = 0.5 * std::numbers::pi;
  std::vector<Vec3> out;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j < 4 * kSteps; ++j) {
      const double theta = kRightAngle * i / kSteps, phi = kRightAngle * j / kSteps;
      out.emplace_back(std::cos(theta), std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi));
    }
  return out;
}

bool is_positive_definite(const Mat3& A) {  // by the leading minors
  return A(0, 0) > 0 && A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0) > 0 && A.determinant() > 0;
}

// Whether the law is strongly elliptic: the acoustic tensor A_ac = H_abcd n_b n_d with H = d2Psi/dF2 is positive
// definite for all sampled directions n.
bool is_strongly_elliptic(const Mat9& H) {
  static const std::vector<Vec3> directions = half_sphere();
  for (const Vec3& n : directions) {
    Mat3 A = Mat3::Zero();
    for (int b = 0; b < 3; ++b)
      for (int d = 0; d < 3; ++d) A += n[b] * n[d] * H.block<3, 3>(3 * b, 3 * d);
    if (!is_positive_definite(A)) return false;
  }
  return true;
}

std::array<AxisLimits, 3> searched_limits(const AnisotropicStiffness& C) {
  const CorotationalLaw law(AnisotropicStiffness{C.c / C.c.diagonal().maxCoeff()});
  const Mat6 S = compliance(C.c);
  std::array<AxisLimits, 3> out;
  for (int axis = 0; axis < 3; ++axis) {
    const Mat3 unit = uniaxial_strain(S, axis);
    const auto holds = [&](double strain) {
      const Mat3 H = strain * unit, I = Mat3::Identity();
      if (!is_positive_definite(I + H)) return false;
      return is_strongly_elliptic(expand(law.tangent(H, I, TangentKind::exact, 0, nullptr)));
    };
    AxisLimits& limits = out[static_cast<std::size_t>(axis)];
    if (const auto e = first_failure(holds, -0.95)) limits.compression = {*e, LimitKind::oblique, axis};
    if (const auto e = first_failure(holds, 1)) limits.tension = {*e, LimitKind::oblique, axis};
  }
  return out;
}

}  // namespace

std::array<AxisLimits, 3> strain_limits(const Stiffness& stiffness) {
  if (const auto* full = std::get_if<AnisotropicStiffness>(&stiffness)) return searched_limits(*full);
  return orthotropic_limits(compliance(voigt(stiffness)));
}

Mat36 stress_over_young(const Stiffness& stiffness) {
  const Mat6 C = voigt(stiffness);
  return compliance(C).diagonal().head<3>().asDiagonal() * C.topRows<3>();
}

std::string describe(const StrainLimit& limit, int axis) {
  const int low = std::min(axis, limit.plane) + 1, high = std::max(axis, limit.plane) + 1;
  switch (limit.kind) {
    case LimitKind::kink: return fmt::format("kinks in the plane {}-{}", low, high);
    case LimitKind::slide: return fmt::format("slides in the plane {}-{}", low, high);
    case LimitKind::flat: break;
    case LimitKind::oblique: return "waves in some direction cannot propagate";
  }
  return fmt::format("is flat along {}", limit.plane + 1);
}

}  // namespace orthodyn
