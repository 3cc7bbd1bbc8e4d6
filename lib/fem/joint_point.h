// A point of a body that a joint holds: a mean of nodes, x = sum_i w_i x_i, whose weights have the sum 1 and give the
// point itself in the rest shape. It moves with every affine motion of the nodes, rotations included, and a force F at
// the point acts on the nodes as w_i F: forces and torques of both sides of a joint cancel exactly.
#pragma once

#include <utility>
#include <vector>

#include "lib/fem/nodal_vector.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

struct JointPoint {
  std::vector<std::pair<int, double>> weights;  // of nodes; empty for a point in space
  Vec3 rest = Vec3::Zero();                     // m

  // The mean of nodal values, such as displacements; zero for a point in space.
  Vec3 mean(const NodalVector& nodal) const {
    Vec3 sum = Vec3::Zero();
    for (const auto& [node, weight] : weights) sum += weight * nodal.col(node);
    return sum;
  }
};

// The mean of these nodes that lies at `point`, with the least sum of squared weights. Empty weights if there is none:
// if the nodes lie in a plane or on a line that does not contain the point.
JointPoint joint_point(const Mesh& mesh, const std::vector<int>& nodes, const Vec3& point);

}  // namespace orthodyn
