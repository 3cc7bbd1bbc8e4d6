// The nodes that hold a joint's coordinate c (joint_coordinate.h): assembly of a force along c, which acts on the nodes
// by dc/dx, and of its tangent.
#pragma once

#include <vector>

#include "lib/fem/block_pattern.h"
#include "lib/fem/joint_coordinate.h"

namespace orthodyn {

class CoordinateNodes {
 public:
  explicit CoordinateNodes(const JointCoordinate& coordinate);

  // Adds `force` dc/dx (N, or N m).
  void add_force(double force, const JointCoordinate::Expansion& at, NodalVector& f) const;

  // Adds outer dc/dx dc/dx^T - force d2c/dx2 to `values`.
  void add_tangent(double outer, double force, const JointCoordinate::Expansion& at, const BlockPattern& pattern,
                   double* values) const;

  // All pairs of these nodes.
  NodePairs pairs() const;

 private:
  struct Node {
    int index;
    Vector weights;  // in each point of the coordinate
  };
  static Vec3 slope(const Node& node, const Vector& of_points);
  static Mat3 curvature(const Node& a, const Node& b, const Eigen::MatrixXd& of_points);

  std::vector<Node> nodes_;
};

}  // namespace orthodyn
