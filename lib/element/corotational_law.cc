#include "lib/element/corotational_law.h"

namespace orthodyn {

namespace {

// a(dS T^T) as a 3x6 matrix on the Voigt form of dS. Inlined by order: with two kinds of stiffness the
// compiler would not, and tangents cost 4 % more instructions.
[[gnu::always_inline]] inline Mat36 axial_of_product(const Mat3& T) {
  const Mat3 h = 0.5 * T;
  Mat36 A;
  A << 0, -T(2, 1), T(1, 2), -h(2, 0), h(1, 1) - h(2, 2), h(1, 0),  //
      T(2, 0), 0, -T(0, 2), h(2, 1), -h(0, 1), h(2, 2) - h(0, 0),   //
      -T(1, 0), T(0, 1), 0, h(0, 0) - h(1, 1), h(0, 2), -h(1, 2);
  return A;
}

[[gnu::always_inline]] inline Mat63 times(const OrthotropicStiffness& C, const Mat63& N) {
  Mat63 out;
  out.row(0) = C.c11 * N.row(0) + C.c12 * N.row(1) + C.c31 * N.row(2);
  out.row(1) = C.c12 * N.row(0) + C.c22 * N.row(1) + C.c23 * N.row(2);
  out.row(2) = C.c31 * N.row(0) + C.c23 * N.row(1) + C.c33 * N.row(2);
  out.row(3) = C.g12 * N.row(3);
  out.row(4) = C.g23 * N.row(4);
  out.row(5) = C.g31 * N.row(5);
  return out;
}

Mat63 times(const AnisotropicStiffness& C, const Mat63& N) { return C.c * N; }

}  // namespace

Mat3 solve_lyapunov(const Mat3& S, const Mat3& B) {
  const Eigen::SelfAdjointEigenSolver<Mat3> modes(S);
  const Mat3& V = modes.eigenvectors();
  const Vec3& s = modes.eigenvalues();
  Mat3 X = V.transpose() * B * V;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) X(i, j) /= s[i] + s[j];
  return V * X * V.transpose();
}

Mat63 stretch_rate_matrix(const Mat3& S) {
  Mat63 N;
  N << 0, S(0, 2), -S(0, 1),                       //
      -S(1, 2), 0, S(0, 1),                        //
      S(1, 2), -S(0, 2), 0,                        //
      -S(0, 2), S(1, 2), S(0, 0) - S(1, 1),        //
      S(1, 1) - S(2, 2), -S(0, 1), S(0, 2),        //
      S(0, 1), S(2, 2) - S(0, 0), -S(1, 2);
  return N;
}

template <class C>
TangentFormOf<C> gauss_newton_form(const Polar<double>& p, const C& stiffness, double chi) {
  TangentFormOf<C> form;
  form.R = p.R;
  if (chi == 0) {  // G may be singular: nothing to weigh
    form.Hee = {};
    form.Hea.setZero();
    form.Hae.setZero();
    form.Haa.setZero();
    return form;
  }
  form.Hee = chi * stiffness;
  const Mat63 N = stretch_rate_matrix(p.S) * p.G_inverse;
  const Mat63 CN = times(form.Hee, N);
  form.Hea = -CN;
  form.Hae = form.Hea.transpose();
  form.Haa = N.transpose() * CN;
  return form;
}

template <class C>
TangentFormOf<C> exact_form(const Polar<double>& p, const C& stiffness, const Mat3& T) {
  TangentFormOf<C> form;
  form.R = p.R;
  form.Hee = stiffness;
  const Mat63 N = stretch_rate_matrix(p.S);
  const Mat63 CN = times(stiffness, N);
  const Mat36 A = axial_of_product(T);
  const Mat3 AN = A * N;
  const Mat3 tau = symmetric_part<double>(T * p.S);
  const Mat3 Hww = N.transpose() * CN - AN - AN.transpose() + tau.trace() * Mat3::Identity() - tau;
  form.Hea = (A.transpose() - CN) * p.G_inverse;
  form.Hae = form.Hea.transpose();
  form.Haa = p.G_inverse * Hww * p.G_inverse;
  return form;
}

template TangentForm gauss_newton_form(const Polar<double>&, const OrthotropicStiffness&, double);
template TangentForm exact_form(const Polar<double>&, const OrthotropicStiffness&, const Mat3&);
template TangentFormOf<AnisotropicStiffness> gauss_newton_form(const Polar<double>&, const AnisotropicStiffness&,
                                                               double);
template TangentFormOf<AnisotropicStiffness> exact_form(const Polar<double>&, const AnisotropicStiffness&, const Mat3&);

}  // namespace orthodyn
