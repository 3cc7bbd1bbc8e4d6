// For tests: random numbers, sets of elastic constants, and C as a tensor.
#pragma once

#include <cmath>
#include <random>

#include "lib/material/anisotropy.h"
#include "lib/material/orthotropy.h"

namespace orthodyn {

inline constexpr double kEps = 2.220446049250313e-16;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * std::generate_canonical<double, 53>(engine_); }
  Vec3 vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
  Mat3 matrix() { return (Mat3() << vector(), vector(), vector()).finished(); }
  Mat3 rotation() {
    Eigen::Quaterniond q(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
    return q.normalized().toRotationMatrix();
  }

 private:
  std::mt19937 engine_;
};

// Constants with the scaled Poisson's ratios r = (r12, r23, r31), r_ij = nu_ij sqrt(E_j / E_i).
OrthotropicConstants with_scaled_ratios(const Vec3& young, const Vec3& r);

// The stable family of Li & Barbic (2014) with the parameter nu, including its shear moduli.
OrthotropicConstants stable_family(const Vec3& young, double nu);

// Spruce, moduli in GPa; nu31 = 0.0225.
OrthotropicConstants spruce();

// The matrix Rho: 1 on the diagonal, -r_ij off it. With positive moduli, C is positive definite if and only if
// Rho is.
Mat3 rho_matrix(const Vec3& r);

// Random constants with moduli from 0.01 to 100 and all eigenvalues of Rho at least `margin`.
OrthotropicConstants random_stable(Random& random, double margin = 0.05);

// The component C_ijkl of a Voigt matrix; indices from 0 to 2.
double component(const Mat6& C, int i, int j, int k, int l);

}  // namespace orthodyn
