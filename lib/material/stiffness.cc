#include "lib/material/stiffness.h"

#include <Eigen/LU>
#include <array>
#include <utility>

namespace orthodyn {

OrthotropicStiffness operator+(const OrthotropicStiffness& a, const OrthotropicStiffness& b) {
  return {a.c11 + b.c11, a.c22 + b.c22, a.c33 + b.c33, a.c12 + b.c12, a.c23 + b.c23,
          a.c31 + b.c31, a.g12 + b.g12, a.g23 + b.g23, a.g31 + b.g31};
}

OrthotropicStiffness operator*(double s, const OrthotropicStiffness& c) {
  return {s * c.c11, s * c.c22, s * c.c33, s * c.c12, s * c.c23, s * c.c31, s * c.g12, s * c.g23, s * c.g31};
}

AnisotropicStiffness operator+(const AnisotropicStiffness& a, const AnisotropicStiffness& b) { return {a.c + b.c}; }

AnisotropicStiffness operator+(const AnisotropicStiffness& a, const OrthotropicStiffness& b) {
  return {a.c + voigt(b)};
}

AnisotropicStiffness operator*(double s, const AnisotropicStiffness& c) { return {s * c.c}; }

OrthotropicStiffness as_orthotropic(const IsotropicStiffness& c) {
  OrthotropicStiffness out;
  out.c11 = out.c22 = out.c33 = c.lambda + 2 * c.mu;
  out.c12 = out.c23 = out.c31 = c.lambda;
  out.g12 = out.g23 = out.g31 = c.mu;
  return out;
}

double bulk_modulus(const Stiffness& c) {
  if (const auto* isotropic = std::get_if<IsotropicStiffness>(&c)) return isotropic->lambda + 2 * isotropic->mu / 3;
  const Mat6 compliance = voigt(c).inverse();
  return 1 / compliance.topLeftCorner<3, 3>().sum();
}

IsotropicStiffness without_bulk(IsotropicStiffness c, double kappa) {
  c.lambda -= kappa;
  return c;
}

OrthotropicStiffness without_bulk(OrthotropicStiffness c, double kappa) {
  for (double* normal : {&c.c11, &c.c22, &c.c33, &c.c12, &c.c23, &c.c31}) *normal -= kappa;
  return c;
}

AnisotropicStiffness without_bulk(AnisotropicStiffness c, double kappa) {
  c.c.topLeftCorner<3, 3>().array() -= kappa;
  return c;
}

Mat6 voigt(const OrthotropicStiffness& c) {
  Mat6 m = Mat6::Zero();
  m.topLeftCorner<3, 3>() << c.c11, c.c12, c.c31, c.c12, c.c22, c.c23, c.c31, c.c23, c.c33;
  m.diagonal().tail<3>() << c.g12, c.g23, c.g31;
  return m;
}

Mat6 voigt(const IsotropicStiffness& c) { return voigt(as_orthotropic(c)); }

Mat6 voigt(const Stiffness& c) {
  return std::visit([](const auto& form) -> Mat6 { return voigt(form); }, c);
}

IsotropicStiffness nearest_isotropic(const OrthotropicStiffness& c) {
  return nearest_isotropic(AnisotropicStiffness{voigt(c)});
}

IsotropicStiffness nearest_isotropic(const AnisotropicStiffness& c) {
  const double iijj = c.c.topLeftCorner<3, 3>().sum();
  const double ijij = c.c.diagonal().head<3>().sum() + 2 * c.c.diagonal().tail<3>().sum();
  const double bulk = iijj / 9;
  const double mu = (ijij - iijj / 3) / 10;
  return {bulk - 2 * mu / 3, mu};
}

Mat6 stress_rotation(const Mat3& Q) {
  constexpr std::array<std::pair<int, int>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  Mat6 K;
  for (int row = 0; row < 6; ++row) {
    const auto [i, j] = pair[static_cast<std::size_t>(row)];
    for (int column = 0; column < 6; ++column) {
      const auto [k, l] = pair[static_cast<std::size_t>(column)];
      K(row, column) = k == l ? Q(i, k) * Q(j, k) : Q(i, k) * Q(j, l) + Q(i, l) * Q(j, k);
    }
  }
  return K;
}

}  // namespace orthodyn
