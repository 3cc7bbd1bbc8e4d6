// Sets of elastic constants, and C as a tensor, for tests.
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

// Constants with the given r12, r23, r31.
OrthotropicConstants with_scaled_ratios(const Vec3& young, const Vec3& r);

// Li & Barbic's family, with its shear moduli.
OrthotropicConstants stable_family(const Vec3& young, double nu);

// GPa; nu31 = 0.0225.
OrthotropicConstants spruce();

Mat3 rho_matrix(const Vec3& r);

// Moduli over four decades, smallest eigenvalue of Rho above `margin`.
OrthotropicConstants random_stable(Random& random, double margin = 0.05);

// C_ijkl of a Voigt matrix, indices 0, 1, 2.
double component(const Mat6& C, int i, int j, int k, int l);

}  // namespace orthodyn
