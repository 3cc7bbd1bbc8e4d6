// The second variation of an energy at a point, in the rotated frame.
//
// For a change dF let X = R^T dF, e = sym(X) in Voigt form (engineering shear), a = a(X). Then
//     d2Psi = e . Hee e + 2 e . Hea a + a . Haa a.
// Every corotational tangent has this form; Hee is a material stiffness: nine numbers if orthotropic.
// A tangent that is not symmetric has its own Hae (3x6) in place of Hea^T.
#pragma once

#include <array>

#include "lib/element/axial.h"
#include "lib/material/stiffness.h"

namespace orthodyn {

using Mat63 = Eigen::Matrix<double, 6, 3>;
using Mat36 = Eigen::Matrix<double, 3, 6>;
using Mat9 = Eigen::Matrix<double, 9, 9>;

template <class C>
struct TangentFormOf {
  Mat3 R;
  C Hee;
  Mat63 Hea;
  Mat36 Hae;
  Mat3 Haa;
};

using TangentForm = TangentFormOf<OrthotropicStiffness>;

// The form as a 9x9 matrix acting on X in column-major order (X11, X21, X31, X12, ...).
template <class C>
[[gnu::always_inline]] inline Mat9 expand(const TangentFormOf<C>& form) {
  Eigen::Matrix<double, 9, 9> H;  // on (e, a)
  H.topLeftCorner<6, 6>() = voigt(form.Hee);
  H.topRightCorner<6, 3>() = form.Hea;
  H.bottomLeftCorner<3, 6>() = form.Hae;
  H.bottomRightCorner<3, 3>() = form.Haa;

  // X_ij + X_ji = gamma, X_ji - X_ij = +-a: each off-diagonal entry of X meets one of each.
  struct Shear {
    int gamma, a, plus, minus;  // plus: the entry of X with +a
  };
  constexpr std::array<Shear, 3> shears{{{3, 8, 1, 3}, {4, 6, 5, 7}, {5, 7, 6, 2}}};
  Eigen::Matrix<double, 9, 9> rows, out;
  for (int k = 0; k < 3; ++k) rows.row(4 * k) = H.row(k);
  for (const auto& s : shears) {
    rows.row(s.plus) = H.row(s.gamma) + H.row(s.a);
    rows.row(s.minus) = H.row(s.gamma) - H.row(s.a);
  }
  for (int k = 0; k < 3; ++k) out.col(4 * k) = rows.col(k);
  for (const auto& s : shears) {
    out.col(s.plus) = rows.col(s.gamma) + rows.col(s.a);
    out.col(s.minus) = rows.col(s.gamma) - rows.col(s.a);
  }
  return out;
}

}  // namespace orthodyn
