#include "lib/fem/ground.h"

#include <fmt/format.h>

namespace orthodyn {

namespace {

// psi(d) and its derivatives.
double penalty(double d, double w) { return d <= 0 ? 0 : d < w ? d * d * d / (6 * w) : d * (d - w) / 2 + w * w / 6; }
double slope(double d, double w) { return d <= 0 ? 0 : d < w ? d * d / (2 * w) : d - w / 2; }
double curvature(double d, double w) { return d <= 0 ? 0 : d < w ? d / w : 1; }

}  // namespace

std::string Ground::description() const {
  return fmt::format("ground plane for {} nodes, {:.6g} Pa/m", areas_.size(), plane_.stiffness);
}

void Ground::add_force(const NodalState& s, NodalVector& f) const {
  for (const auto& [node, area] : areas_)
    if (const double d = depth(node, s.x); d > 0)
      f.col(node) += plane_.stiffness * area * slope(d, plane_.onset) * plane_.normal;
}

void Ground::add_tangent(const NodalState& s, TangentKind, double* stiffness, double*) const {
  const Mat3 across = plane_.stiffness * plane_.normal * plane_.normal.transpose();
  for (const auto& [node, area] : areas_)
    if (const double d = depth(node, s.x); d > 0)
      pattern_.add(node, node, pattern_.offset(node, node), area * curvature(d, plane_.onset) * across, stiffness);
}

double Ground::energy(const NodalState& s) const {
  double sum = 0;
  for (const auto& [node, area] : areas_) sum += area * penalty(depth(node, s.x), plane_.onset);
  return plane_.stiffness * sum;
}

void Ground::add_stiffness_bound(Vector& row_sums) const {
  for (const auto& [node, area] : areas_) row_sums[node] += plane_.stiffness * area;
}

}  // namespace orthodyn
