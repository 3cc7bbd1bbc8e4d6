#include "lib/material/strength.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orthodyn {

namespace {

double square(double x) { return x * x; }

// 1/R, where R > 0 solves quadratic R^2 + linear R = 1; 0 if there is no such R and the stress never causes failure.
double exposure(double quadratic, double linear) {
  return 0.5 * (linear + std::sqrt(std::max(linear * linear + 4 * quadratic, 0.0)));
}

}  // namespace

const Spec<Strength>& Strength::spec() {
  const Rule rule{.required = true, .unit = "Pa", .range = kPositive};
  static const auto s =
      Spec<Strength>()
          .key("tension", &Strength::tension, "Along the material axes 1, 2, 3.", rule)
          .key("compression", &Strength::compression, "Along the material axes 1, 2, 3; positive.", rule)
          .key("shear", &Strength::shear, "In the planes 1-2, 2-3, 3-1.", rule);
  return s;
}

const Spec<UniformStrength>& UniformStrength::spec() {
  const Rule rule{.required = true, .unit = "Pa", .range = kPositive};
  static const auto s = Spec<UniformStrength>()
                            .key("tension", &UniformStrength::tension, "In any direction.", rule)
                            .key("compression", &UniformStrength::compression, "In any direction; positive.", rule)
                            .key("shear", &UniformStrength::shear, "In any plane.", rule);
  return s;
}

double max_stress_exposure(const Vec6& s, const Strength& strength) {
  if (!s.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    largest = std::max(largest, s[i] > 0 ? s[i] / strength.tension[i] : -s[i] / strength.compression[i]);
    largest = std::max(largest, std::abs(s[3 + i]) / strength.shear[i]);
  }
  return largest;
}

double tsai_wu_exposure(const Vec6& s, const Strength& strength) {
  const Vec3 &X = strength.tension, &Y = strength.compression;
  const Vec3 F = X.cwiseInverse() - Y.cwiseInverse(), FF = X.cwiseProduct(Y).cwiseInverse();
  double quadratic = 0;
  for (int i = 0; i < 3; ++i) {
    quadratic += FF[i] * square(s[i]) + square(s[3 + i] / strength.shear[i]);
    const int j = (i + 1) % 3;
    quadratic -= std::sqrt(FF[i] * FF[j]) * s[i] * s[j];
  }
  return exposure(quadratic, F.dot(s.head<3>()));
}

double hashin_exposure(const Vec6& s, const Strength& strength) {
  if (!s.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  const double along = square(strength.shear[0]), across = square(strength.shear[1]);
  const double axial_shear = (square(s[3]) + square(s[5])) / along;
  const double fibre =
      s[0] > 0 ? std::sqrt(square(s[0] / strength.tension[0]) + axial_shear) : -s[0] / strength.compression[0];
  const double sum = s[1] + s[2], transverse = (square(s[4]) - s[1] * s[2]) / across;
  const double matrix =
      sum > 0 ? exposure(square(sum / strength.tension[1]) + transverse + axial_shear, 0)
              : exposure(square(sum) / (4 * across) + transverse + axial_shear,
                         (square(strength.compression[1]) / (4 * across) - 1) * sum / strength.compression[1]);
  return std::max({fibre, matrix, 0.0});
}

}  // namespace orthodyn
