// Plies that share a cell although their transverse shear stiffness differs. A cell has one field of displacements
// through its plies and shears them nearly alike, so that a soft ply does not slide between stiff ones.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

using Mat2 = Eigen::Matrix2d;

constexpr double kSmallestReported = 0.01;  // share of the deflection
constexpr double kShortSide = 0.25;         // sides of the region below this share of its longest one carry no span

// Plies with the same cells, bottom first.
using Level = std::vector<const ElasticTerm*>;

// Stiffness of a ply against transverse shear (13, 23), Pa.
Mat2 shear_stiffness(const ElasticTerm& ply, const Mat3& axes) {
  const Mat6 C = ply.stiffness();
  Mat2 own;
  own << C(5, 5), C(5, 4), C(4, 5), C(4, 4);
  const Mat2 turn = (axes.transpose() * ply.axes_at_rest(0, 0)).topLeftCorner<2, 2>();
  return turn * own * turn.transpose();
}

// Young's modulus of a ply along each of the axes 1 and 2, Pa.
Eigen::Vector2d young_moduli(const ElasticTerm& ply, const Mat3& axes) {
  const Mat6 K = stress_rotation(axes.transpose() * ply.axes_at_rest(0, 0));
  const Mat6 S = Mat6(K * ply.stiffness() * K.transpose()).inverse();
  return {1 / S(0, 0), 1 / S(1, 1)};
}

// Integral from z = -1 to z of (9/4)(1 - z^2)^2 / 2, the squared shear stress of a homogeneous plate of thickness 2.
double shear_weight(double z) { return 9.0 / 8 * (z - 2 * z * z * z / 3 + std::pow(z, 5) / 5 + 8.0 / 15); }

// Extent of the given nodes along a unit vector, m.
double extent_along(const Vec3& direction, const Eigen::Matrix3Xd& nodes) {
  const Eigen::RowVectorXd along = direction.transpose() * nodes;
  return along.maxCoeff() - along.minCoeff();
}

Eigen::Matrix3Xd nodes_of(const FemModel::Parts& parts, const std::vector<int>& cells) {
  std::vector<int> nodes;
  for (const int cell : cells) {
    const auto own = parts.mesh.cells[static_cast<std::size_t>(cell)];
    nodes.insert(nodes.end(), own.begin(), own.end());
  }
  return (*parts.rest)(Eigen::all, nodes);
}

// The missing shear of a span that is clamped at both ends over its bending, the larger one of axes 1 and 2 of the
// lowest ply: (2 pi H / L)^2 / 12 E (1/G - 1/G'), where G' takes the plies of a cell as parallel. H is the thickness of
// the stack and L the length of the region. Assumes a flat region with the shear stresses of a homogeneous plate.
double missing_shear(const std::vector<Level>& levels, const FemModel::Parts& parts) {
  const Mat3 axes = levels.front().front()->axes_at_rest(0, 0);
  std::vector<double> heights;
  std::vector<int> all;
  for (const Level& level : levels) {
    const std::vector<int>& cells = level.front()->definition().cells;
    heights.push_back(extent_along(axes.col(2), nodes_of(parts, {cells.front()})));
    all.insert(all.end(), cells.begin(), cells.end());
  }
  const double H = std::accumulate(heights.begin(), heights.end(), 0.0);
  Mat2 missing = Mat2::Zero();
  Eigen::Vector2d young = Eigen::Vector2d::Zero();
  double z = -1;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    Mat2 parallel = Mat2::Zero();
    const double bottom = z;
    for (const ElasticTerm* ply : levels[l]) {
      const double share = ply->definition().share, top = z + 2 * share * heights[l] / H;
      const Mat2 D = shear_stiffness(*ply, axes);
      parallel += share * D;
      missing += (shear_weight(top) - shear_weight(z)) * D.inverse();
      young += (top * top * top - z * z * z) / 2 * young_moduli(*ply, axes);
      z = top;
    }
    missing -= (shear_weight(z) - shear_weight(bottom)) * parallel.inverse();
  }
  const Eigen::Matrix3Xd nodes = nodes_of(parts, all);
  const Eigen::Vector2d spans(extent_along(axes.col(0), nodes), extent_along(axes.col(1), nodes));
  double most = 0;
  for (int i = 0; i < 2; ++i)
    if (spans[i] > kShortSide * spans.maxCoeff()) {
      const double slope = 2 * std::numbers::pi * H / spans[i];
      most = std::max(most, slope * slope / 12 * young[i] * missing(i, i));
    }
  return most;
}

// The levels of each layered region, bottom first: terms are in this order (lib/scene/layup.h).
std::map<std::string, std::vector<Level>> levels_by_region(const FemModel::Parts& parts) {
  std::map<std::string, std::vector<Level>> regions;
  for (const auto& term : parts.elastic) {
    const ElasticRegion& region = term->definition();
    if (region.ply.empty() || region.cells.empty()) continue;
    std::vector<Level>& levels = regions[region.mesh_region];
    if (levels.empty() || levels.back().front()->definition().cells != region.cells) levels.emplace_back();
    levels.back().push_back(term.get());
  }
  return regions;
}

}  // namespace

void check_layers(const CheckContext& context, Warnings& out) {
  const FemModel::Parts& parts = context.built.model->parts();
  if (parts.subdomain) return;
  for (const auto& [region, levels] : levels_by_region(parts)) {
    const double missing = missing_shear(levels, parts);
    if (missing < kSmallestReported) continue;
    warn(out, context.config.at("regions").where(),
         "region '{}': plies that share a cell differ in transverse shear stiffness. One cell shears them alike, so "
         "that deflections may be up to about {:.2g} % too small and frequencies {:.2g} % too high. Give each ply "
         "cells of its own, such as three cells through three plies",
         region, 100 * missing / (1 + missing), 100 * (std::sqrt(1 + missing) - 1));
  }
}

}  // namespace orthodyn::input_checks
