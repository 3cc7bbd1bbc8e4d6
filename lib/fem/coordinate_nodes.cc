#include "lib/fem/coordinate_nodes.h"

#include <set>

namespace orthodyn {

CoordinateNodes::CoordinateNodes(const JointCoordinate& coordinate) {
  std::set<int> indices;
  for (const JointPoint& point : coordinate.points())
    for (const auto& [node, weight] : point.weights) indices.insert(node);
  for (const int index : indices) {
    Vector weights = Vector::Zero(std::ssize(coordinate.points()));
    for (std::size_t p = 0; p < coordinate.points().size(); ++p)
      for (const auto& [of, weight] : coordinate.points()[p].weights)
        if (of == index) weights[static_cast<Eigen::Index>(p)] += weight;
    nodes_.push_back({index, std::move(weights)});
  }
}

void CoordinateNodes::add_force(double force, const JointCoordinate::Expansion& at, NodalVector& f) const {
  for (const Node& node : nodes_) f.col(node.index) += force * slope(node, at.slope);
}

void CoordinateNodes::add_tangent(double outer, double force, const JointCoordinate::Expansion& at,
                                  const BlockPattern& pattern, double* values) const {
  for (const Node& a : nodes_)
    for (const Node& b : nodes_) {
      if (pattern.symmetric() && a.index < b.index) continue;
      Mat3 block = outer * slope(a, at.slope) * slope(b, at.slope).transpose();
      if (force != 0) block -= force * curvature(a, b, at.curvature);
      pattern.add(a.index, b.index, pattern.offset(a.index, b.index), block, values);
    }
}

NodePairs CoordinateNodes::pairs() const {
  NodePairs out;
  for (auto a = nodes_.begin(); a != nodes_.end(); ++a)
    for (auto b = nodes_.begin(); b != a; ++b) out.emplace_back(a->index, b->index);
  return out;
}

Vec3 CoordinateNodes::slope(const Node& node, const Vector& of_points) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index p = 0; p < node.weights.size(); ++p) sum += node.weights[p] * of_points.segment<3>(3 * p);
  return sum;
}

Mat3 CoordinateNodes::curvature(const Node& a, const Node& b, const Eigen::MatrixXd& of_points) {
  Mat3 sum = Mat3::Zero();
  for (Eigen::Index p = 0; p < a.weights.size(); ++p)
    for (Eigen::Index r = 0; r < b.weights.size(); ++r)
      sum += a.weights[p] * b.weights[r] * of_points.block<3, 3>(3 * p, 3 * r);
  return sum;
}

}  // namespace orthodyn
