// The second variation of an energy density at a point, in the rotated frame.
//
// For a change dF let X = R^T dF, e = sym(X) in Voigt form (engineering shear), and a = a(X) (axial.h). Then
//     d2Psi = e . Hee e + 2 e . Hea a + a . Haa a.
// Every corotational tangent has this form. Hee is a material stiffness (nine numbers if orthotropic). Unsymmetric
// tangents have a separate Hae (3x6) in place of Hea^T.
#pragma once

#include <array>

#include "lib/element/axial.h"
#include "lib/material/stiffness.h"

namespace orthodyn {

template <class T>
using Mat63T = Eigen::Matrix<T, 6, 3>;
template <class T>
using Mat36T = Eigen::Matrix<T, 3, 6>;
template <class T>
using Mat9T = Eigen::Matrix<T, 9, 9>;
using Mat63 = Mat63T<double>;
using Mat36 = Mat36T<double>;
using Mat9 = Mat9T<double>;

// For one point (T = double), or for a batch of points with the same Hee (T = Batch).
template <class C, class T = double>
struct TangentFormOf {
  Mat3T<T> R;
  C Hee;
  Mat63T<T> Hea;
  Mat36T<T> Hae;
  Mat3T<T> Haa;
};

using TangentForm = TangentFormOf<OrthotropicStiffness>;

namespace tangent_detail {

// A shear component: gamma = X_ij + X_ji and +-a = X_ji - X_ij.
struct Shear {
  int gamma, a, plus, minus;  // indices; plus and minus: the entries of X (column-major) in which a has this sign
};
inline constexpr std::array<Shear, 3> kShears{{{3, 8, 1, 3}, {4, 6, 5, 7}, {5, 7, 6, 2}}};

}  // namespace tangent_detail

// The form as a 9x9 matrix acting on X in column-major order (X11, X21, X31, X12, ...).
template <class C, class T>
[[gnu::always_inline]] inline Mat9T<T> expand(const TangentFormOf<C, T>& form) {
  using tangent_detail::kShears;
  const Mat6 C6 = voigt(form.Hee);
  Mat9T<T> out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out(4 * i, 4 * j) = T(C6(i, j));
  for (const auto& s : kShears)
    for (int i = 0; i < 3; ++i) {
      out(4 * i, s.plus) = T(C6(i, s.gamma)) + form.Hea(i, s.a - 6);
      out(4 * i, s.minus) = T(C6(i, s.gamma)) - form.Hea(i, s.a - 6);
      out(s.plus, 4 * i) = T(C6(s.gamma, i)) + form.Hae(s.a - 6, i);
      out(s.minus, 4 * i) = T(C6(s.gamma, i)) - form.Hae(s.a - 6, i);
    }
  for (const auto& r : kShears)
    for (const auto& c : kShears) {
      const T e(C6(r.gamma, c.gamma)), ea = form.Hea(r.gamma, c.a - 6), ae = form.Hae(r.a - 6, c.gamma),
                                       aa = form.Haa(r.a - 6, c.a - 6);
      const T even = e + aa, odd = e - aa, up = ea + ae, down = ea - ae;
      out(r.plus, c.plus) = even + up;
      out(r.minus, c.minus) = even - up;
      out(r.plus, c.minus) = odd - down;
      out(r.minus, c.plus) = odd + down;
    }
  return out;
}

// Rotates the matrix H of expand(): it maps R^T dF to R^T dP before and dF to dP afterwards.
template <class T>
[[gnu::always_inline]] inline void turn_to_space(const Mat3T<T>& R, Mat9T<T>& H) {
  const auto turn = [&R](auto&& a, auto&& b, auto&& c) {
    const T x = a, y = b, z = c;
    a = R(0, 0) * x + R(0, 1) * y + R(0, 2) * z;
    b = R(1, 0) * x + R(1, 1) * y + R(1, 2) * z;
    c = R(2, 0) * x + R(2, 1) * y + R(2, 2) * z;
  };
  for (int column = 0; column < 9; ++column)
    for (int m = 0; m < 9; m += 3) turn(H(m, column), H(m + 1, column), H(m + 2, column));
  for (int row = 0; row < 9; ++row)
    for (int n = 0; n < 9; n += 3) turn(H(row, n), H(row, n + 1), H(row, n + 2));
}

}  // namespace orthodyn
