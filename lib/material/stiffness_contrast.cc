#include "lib/material/stiffness_contrast.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

namespace {

constexpr double kVolumetric = 0.95;          // least cosine between the stiffest strain and a volume change
constexpr double kNearlyIncompressible = 25;  // least ratio; nu = 0.47

// In Mandel's notation, in which stress times strain is work.
auto eigenvalues_of(const Mat6& stiffness) {
  Vec6 scale;
  scale << 1, 1, 1, std::numbers::sqrt2, std::numbers::sqrt2, std::numbers::sqrt2;
  return symmetric_eigenpairs<6>(Mat6(scale.asDiagonal() * stiffness * scale.asDiagonal()));
}

}  // namespace

StiffnessContrast stiffness_contrast(const Mat6& stiffness) {
  const auto pairs = eigenvalues_of(stiffness);
  const double along_volume = std::abs(pairs.vectors.col(5).head<3>().sum()) / std::sqrt(3.0);
  return {pairs.values[5] / pairs.values[0], along_volume > kVolumetric};
}

double contrast_without_bulk(const Stiffness& stiffness) {
  const Mat6 C = voigt(stiffness);
  const double kappa = bulk_modulus(stiffness);
  const Mat6 rest = std::visit([&](const auto& c) { return voigt(without_bulk(c, kappa)); }, stiffness);
  return eigenvalues_of(rest).values[5] / eigenvalues_of(C).values[0];
}

double volumetric_modulus(const Stiffness& stiffness) {
  return std::max(bulk_modulus(stiffness) - eigenvalues_of(voigt(stiffness)).values[0] / 3, 0.0);
}

double excess_bulk_modulus(const Stiffness& stiffness) {
  constexpr double kOfSmallest = 2;
  return std::max(bulk_modulus(stiffness) - kOfSmallest * eigenvalues_of(voigt(stiffness)).values[0], 0.0);
}

bool is_nearly_incompressible(const Stiffness& stiffness) {
  const Mat6 C = voigt(stiffness);
  const auto [ratio, volumetric] = stiffness_contrast(C);
  return volumetric && ratio > kNearlyIncompressible && contrast_without_bulk(stiffness) < ratio / 2;
}

}  // namespace orthodyn
