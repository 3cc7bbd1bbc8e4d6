#include "lib/element/corotational_law.h"

namespace orthodyn {

namespace {

// The 3x6 matrix that maps dS (Voigt form) to a(dS T^T). Without always_inline the compiler would not inline a function
// used for two kinds of stiffness, and tangents would take 4 % more instructions.
template <class T>
[[gnu::always_inline]] inline Mat36T<T> axial_of_product(const Mat3T<T>& stress) {
  const Mat3T<T>& s = stress;
  const Mat3T<T> h = T(0.5) * s;
  const T zero(0);
  Mat36T<T> A;
  A << zero, -s(2, 1), s(1, 2), -h(2, 0), h(1, 1) - h(2, 2), h(1, 0),  //
      s(2, 0), zero, -s(0, 2), h(2, 1), -h(0, 1), h(2, 2) - h(0, 0),   //
      -s(1, 0), s(0, 1), zero, h(0, 0) - h(1, 1), h(0, 2), -h(1, 2);
  return A;
}

template <class T>
[[gnu::always_inline]] inline Mat63T<T> times(const OrthotropicStiffness& C, const Mat63T<T>& N) {
  Mat63T<T> out;
  for (int j = 0; j < 3; ++j) {
    out(0, j) = C.c11 * N(0, j) + C.c12 * N(1, j) + C.c31 * N(2, j);
    out(1, j) = C.c12 * N(0, j) + C.c22 * N(1, j) + C.c23 * N(2, j);
    out(2, j) = C.c31 * N(0, j) + C.c23 * N(1, j) + C.c33 * N(2, j);
    out(3, j) = C.g12 * N(3, j);
    out(4, j) = C.g23 * N(4, j);
    out(5, j) = C.g31 * N(5, j);
  }
  return out;
}

template <class T>
Mat63T<T> times(const AnisotropicStiffness& C, const Mat63T<T>& N) {
  return C.c.template cast<T>().lazyProduct(N);
}

// The 6x3 matrix N in dS = sym(X) - N w, that is sym([w] S) in Voigt form with engineering shear.
template <class T>
[[gnu::always_inline]] inline Mat63T<T> stretch_rate_matrix(const Mat3T<T>& S) {
  const T zero(0);
  Mat63T<T> N;
  N << zero, S(0, 2), -S(0, 1),              //
      -S(1, 2), zero, S(0, 1),               //
      S(1, 2), -S(0, 2), zero,               //
      -S(0, 2), S(1, 2), S(0, 0) - S(1, 1),  //
      S(1, 1) - S(2, 2), -S(0, 1), S(0, 2),  //
      S(0, 1), S(2, 2) - S(0, 0), -S(1, 2);
  return N;
}

}  // namespace

template <class C, class T>
TangentFormOf<C, T> gauss_newton_form(const Polar<T>& p, const C& stiffness) {
  TangentFormOf<C, T> form;
  form.R = p.R;
  form.Hee = stiffness;
  const Mat63T<T> N = stretch_rate_matrix<T>(p.S).lazyProduct(p.G_inverse);
  const Mat63T<T> CN = times(stiffness, N);
  form.Hea = -CN;
  form.Hae = form.Hea.transpose();
  form.Haa = N.transpose().lazyProduct(CN);
  return form;
}

template <class C, class T>
TangentFormOf<C, T> exact_form(const Polar<T>& p, const C& stiffness, const Mat3T<T>& stress) {
  TangentFormOf<C, T> form;
  form.R = p.R;
  form.Hee = stiffness;
  const Mat63T<T> N = stretch_rate_matrix<T>(p.S);
  const Mat63T<T> CN = times(stiffness, N);
  const Mat36T<T> A = axial_of_product<T>(stress);
  const Mat3T<T> AN = A.lazyProduct(N);
  const Mat3T<T> tau = symmetric_part<T>(stress.lazyProduct(p.S));
  Mat3T<T> Hww = N.transpose().lazyProduct(CN);
  Hww -= AN + AN.transpose() + tau;
  const T trace = tau.trace();
  for (int i = 0; i < 3; ++i) Hww(i, i) += trace;
  const Mat63T<T> turning = A.transpose() - CN;
  form.Hea = turning.lazyProduct(p.G_inverse);
  form.Hae = form.Hea.transpose();
  const Mat3T<T> right = Hww.lazyProduct(p.G_inverse);
  form.Haa = p.G_inverse.lazyProduct(right);
  return form;
}

#define ORTHODYN_INSTANTIATE(C, T)                                           \
  template TangentFormOf<C, T> gauss_newton_form(const Polar<T>&, const C&); \
  template TangentFormOf<C, T> exact_form(const Polar<T>&, const C&, const Mat3T<T>&);
ORTHODYN_INSTANTIATE(OrthotropicStiffness, double)
ORTHODYN_INSTANTIATE(OrthotropicStiffness, Batch)
ORTHODYN_INSTANTIATE(AnisotropicStiffness, double)
ORTHODYN_INSTANTIATE(AnisotropicStiffness, Batch)
#undef ORTHODYN_INSTANTIATE

}  // namespace orthodyn
