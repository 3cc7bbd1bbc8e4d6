// For tests: deformation gradients with given principal stretches, stiffnesses, and complex-step derivatives.
#pragma once

#include <complex>

#include "lib/element/tangent_form.h"
#include "tests/material/constants.h"

namespace orthodyn {

using Complex = std::complex<double>;
using CMat3 = Mat3T<Complex>;

// F = R S.
struct Deformation {
  Mat3 R, V;  // rotation; principal axes of S as columns
  Vec3 s;     // signed principal stretches, s1 >= s2 >= |s3|
  Mat3 S() const { return V * s.asDiagonal() * V.transpose(); }
  Mat3 F() const { return R * S(); }
};

Deformation random_state(Random& random, const Vec3& stretches);

// A random state with principal stretches from 1 - strain to 1 + strain.
Deformation random_strain(Random& random, double strain);

// A fibre along axis 1, with the Young's moduli (ratio, 1, 1).
OrthotropicStiffness fibre(double ratio);

// The same material in other axes, as 21 constants. The columns of A are the axes of C in the new ones.
AnisotropicStiffness turned(const OrthotropicStiffness& C, const Mat3& A);

inline constexpr IsotropicStiffness kIsotropic{0.6, 0.4};

inline constexpr double kComplexStep = 1e-60;

// The derivative of f at F in the direction dF, by a complex step. f maps a complex matrix to a complex matrix.
template <class Function>
Mat3 derivative(const Function& f, const Mat3& F, const Mat3& dF) {
  const CMat3 stepped = F.cast<Complex>() + Complex(0, kComplexStep) * dF.cast<Complex>();
  return CMat3(f(stepped)).imag() / kComplexStep;
}

Mat3 unit_matrix(int k);

// The Jacobian of f. Its columns are the derivatives with respect to F11, F21, F31, F12, ...
template <class Function>
Mat9 jacobian(const Function& f, const Mat3& F) {
  Mat9 J;
  for (int k = 0; k < 9; ++k) J.col(k) = derivative(f, F, unit_matrix(k)).reshaped();
  return J;
}

template <class Law>
Mat9 stress_jacobian(const Law& law, const Mat3& F, const Mat3& Q) {
  return jacobian([&](const CMat3& G) { return law.template stress<Complex>(G - Q.cast<Complex>(), Q); }, F);
}

template <class Law>
Mat3 energy_gradient(const Law& law, const Mat3& F, const Mat3& Q) {
  Mat3 P;
  for (int k = 0; k < 9; ++k) {
    CMat3 G = F.cast<Complex>();
    G(k % 3, k / 3) += Complex(0, kComplexStep);
    P(k % 3, k / 3) = law.template energy<Complex>(G - Q.cast<Complex>(), Q).imag() / kComplexStep;
  }
  return P;
}

// The quadratic form as a matrix that acts on dF (in space) instead of on R^T dF.
template <class C>
Mat9 in_space(const TangentFormOf<C>& form) {
  Mat9 R = Mat9::Zero();
  for (int k = 0; k < 3; ++k) R.block<3, 3>(3 * k, 3 * k) = form.R;
  return R * expand(form) * R.transpose();
}

double asymmetry(const Mat9& H);

// The smallest eigenvalue of the symmetric H, divided by its largest one.
double smallest_eigenvalue(const Mat9& H);

// |skew(P F^T)| / |P F^T|: the relative torque that a stress exerts; 0 if angular momentum is conserved.
double torque_fraction(const Mat3& P, const Mat3& F);

}  // namespace orthodyn
