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

// coincide: two points are one. distance: two points keep their distance at rest. across: the span from the second
// point to the first one stays at right angles to that from the second point to the third one.
//
// Both of the latter keep the product r . s of two spans, g = (r . s - r0 . s0) / length(): r from the second to the
// first point and s from the second to the third one, which is the first one if the distance is kept.
struct JointEquation {
  enum class Kind { coincide, distance, across };
  static JointEquation coincide(JointPoint a, JointPoint b) { return {Kind::coincide, std::move(a), std::move(b), {}}; }
  static JointEquation distance(const JointPoint& a, JointPoint b) { return {Kind::distance, a, std::move(b), a}; }
  static JointEquation across(JointPoint a, JointPoint b, JointPoint c) {
    return {Kind::across, std::move(a), std::move(b), std::move(c)};
  }

  Kind kind;
  JointPoint first, second, third;
  int size() const { return kind == Kind::coincide ? 3 : 1; }
  // The derivative of r . s by the first constraint's distance, m.
  double length() const { return (kind == Kind::distance ? 2 : 1) * (third.rest - second.rest).norm(); }
};

struct Joint {
  enum class Of { bodies, rigid_body };  // joint of two bodies, or distances within a rigid body (rigid_body.h)

  std::string name;
  std::string place;  // in the input, for messages
  std::vector<JointEquation> equations;
  Of of = Of::bodies;
};

class FemModel;
struct State;

// Makes a start satisfy the constraints of the model's joints: takes the least change of the velocities by the kinetic
// energy, and computes the multipliers. Returns the largest change of a velocity, m/s. Throws ConfigError, with the
// name of a joint, if points of joints are apart or if constraints depend on each other.
double start_consistently(const FemModel& model, State& state);

}  // namespace orthodyn
