#include "lib/analysis/acoustic.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace orthodyn {

namespace {

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

}  // namespace

bool is_positive_definite(const Mat3& A) {
  return A(0, 0) > 0 && A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0) > 0 && A.determinant() > 0;
}

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

}  // namespace orthodyn
