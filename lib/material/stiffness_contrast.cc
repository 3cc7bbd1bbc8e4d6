#include "lib/material/stiffness_contrast.h"

#include <cmath>
#include <numbers>

#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

namespace {

constexpr double kVolumetric = 0.95;          // least cosine between the stiffest strain and a volume change
constexpr double kNearlyIncompressible = 25;  // least ratio; nu = 0.47

}  // namespace

StiffnessContrast stiffness_contrast(const Mat6& stiffness) {
  Vec6 scale;  // Mandel's notation, in which stress times strain is work
  scale << 1, 1, 1, std::numbers::sqrt2, std::numbers::sqrt2, std::numbers::sqrt2;
  const auto pairs = symmetric_eigenpairs<6>(Mat6(scale.asDiagonal() * stiffness * scale.asDiagonal()));
  const double along_volume = std::abs(pairs.vectors.col(5).head<3>().sum()) / std::sqrt(3.0);
  return {pairs.values[5] / pairs.values[0], along_volume > kVolumetric};
}

bool is_nearly_incompressible(const Mat6& stiffness) {
  const auto [ratio, volumetric] = stiffness_contrast(stiffness);
  return volumetric && ratio > kNearlyIncompressible;
}

}  // namespace orthodyn
