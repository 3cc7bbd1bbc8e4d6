// Plies that share a cell although their transverse shear stiffness differs. A cell has one field of displacements
// through its plies and shears them nearly alike, so that a soft ply does not slide between stiff ones.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

using Mat2 = Eigen::Matrix2d;

constexpr double kTold = 0.01;     // share of the deflection
constexpr double kSlender = 0.25;  // sides of the body below this share of its longest one carry no span

// The plies that share cells, bottom first, in the axes 1 and 2 of the lowest.
struct SharedCells {
  std::vector<const ElasticTerm*> plies;

  const ElasticTerm& lowest() const { return *plies.front(); }
  Mat3 axes() const { return lowest().axes_at_rest(0, 0); }
};

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

// Integral of the squared shear stress (9/4)(1 - z^2)^2 / 2 of a homogeneous plate from z = -1 to z.
double shear_weight(double z) { return 9.0 / 8 * (z - 2 * z * z * z / 3 + std::pow(z, 5) / 5 + 8.0 / 15); }

// By how much too small the deflection is along axes 1 and 2: the missing shear of a clamped span, divided by its
// bending.
double missing_deflection(const SharedCells& shared, double height, const Eigen::Vector2d& spans) {
  const Mat3 axes = shared.axes();
  Mat2 stiffness = Mat2::Zero(), compliance = Mat2::Zero();
  Eigen::Vector2d young = Eigen::Vector2d::Zero();
  double z = -1;
  for (const ElasticTerm* ply : shared.plies) {
    const double top = z + 2 * ply->definition().share;
    const Mat2 D = shear_stiffness(*ply, axes);
    stiffness += ply->definition().share * D;
    compliance += (shear_weight(top) - shear_weight(z)) * D.inverse();
    young += (top * top * top - z * z * z) / 2 * young_moduli(*ply, axes);
    z = top;
  }
  const Mat2 missing = compliance - stiffness.inverse() * 1.2;  // 1.2: of a homogeneous plate
  const double longest = spans.maxCoeff();
  double most = 0;
  for (int i = 0; i < 2; ++i)
    if (spans[i] > kSlender * longest) {
      const double slope = std::numbers::pi * 2 * height / spans[i];
      most = std::max(most, slope * slope / 12 * young[i] * missing(i, i));
    }
  return most;
}

// Elastic terms with the same cells, bottom first, if there is more than one.
std::vector<SharedCells> shared_cells(const FemModel::Parts& parts) {
  std::map<std::pair<std::string, int>, SharedCells> by_first_cell;
  for (const auto& term : parts.elastic) {
    const ElasticRegion& region = term->definition();
    if (region.ply.empty() || region.cells.empty()) continue;
    const int first = *std::min_element(region.cells.begin(), region.cells.end());
    by_first_cell[{region.mesh_region, first}].plies.push_back(term.get());
  }
  std::vector<SharedCells> out;
  for (auto& [place, shared] : by_first_cell)
    if (shared.plies.size() > 1) out.push_back(std::move(shared));
  return out;
}

// Extent of the body along the unit vector, m.
double extent_along(const Vec3& direction, const NodalVector& nodes) {
  const Eigen::RowVectorXd along = direction.transpose() * nodes;
  return along.maxCoeff() - along.minCoeff();
}

}  // namespace

void check_layers(const CheckContext& context, Warnings& out) {
  const FemModel::Parts& parts = context.built.model->parts();
  if (parts.subdomain) return;
  std::map<std::string, double> most;  // by region
  for (const SharedCells& shared : shared_cells(parts)) {
    const Mat3 axes = shared.axes();
    const auto nodes = parts.mesh.cells[static_cast<std::size_t>(shared.lowest().definition().cells.front())];
    const Eigen::Vector2d spans(extent_along(axes.col(0), *parts.rest), extent_along(axes.col(1), *parts.rest));
    const double height =
        extent_along(axes.col(2), (*parts.rest)(Eigen::all, std::vector<int>(nodes.begin(), nodes.end())));
    double& found = most[shared.lowest().definition().mesh_region];
    found = std::max(found, missing_deflection(shared, height, spans));
  }
  for (const auto& [region, missing] : most)
    if (missing > kTold)
      warn(out, context.config.at("regions").where(),
           "region '{}': plies that share a cell differ in transverse shear stiffness. One cell shears them alike, so "
           "that deflections may be up to about {:.2g} % too small and frequencies {:.2g} % too high. Give each ply "
           "cells of its own, such as three cells through three plies",
           region, 100 * missing, 50 * missing);
}

}  // namespace orthodyn::input_checks
