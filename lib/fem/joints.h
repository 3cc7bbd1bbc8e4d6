// Joints between two bodies, or between a body and a point in space, as constraints of a FemModel.
//
// A joint holds points of bodies. Such a point is a mean of nodes, x = sum_i w_i x_i, whose weights have the sum 1 and
// give the point itself in the rest shape. It moves with every affine motion of the nodes, rotations included, and a
// force F at the point acts on the nodes as w_i F: forces and torques of both sides of a joint cancel exactly.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lib/mesh/mesh.h"
#include "lib/ode/constraints.h"

namespace orthodyn {

struct JointPoint {
  std::vector<std::pair<int, double>> weights;  // of nodes; empty for a point in space
  Vec3 rest = Vec3::Zero();                     // m
};

// The mean of these nodes that lies at `point`, with the least sum of squared weights. Empty weights if there is none:
// if the nodes lie in a plane or on a line that does not contain the point.
JointPoint joint_point(const Mesh& mesh, const std::vector<int>& nodes, const Vec3& point);

// Two points that coincide, or that keep their distance at rest.
struct JointEquation {
  enum class Kind { coincide, distance };
  Kind kind = Kind::coincide;
  JointPoint first, second;
  int size() const { return kind == Kind::coincide ? 3 : 1; }
  double length() const { return (first.rest - second.rest).norm(); }  // m
};

struct Joint {
  std::string name;
  std::string place;  // in the input, for messages
  std::vector<JointEquation> equations;
};

class FemModel;
struct State;

// Makes a start satisfy the constraints of the model's joints: takes the least change of the velocities by the kinetic
// energy, and computes the multipliers. Returns the largest change of a velocity, m/s. Throws ConfigError, with the
// name of a joint, if points of joints are apart or if constraints depend on each other.
double start_consistently(const FemModel& model, State& state);

}  // namespace orthodyn
