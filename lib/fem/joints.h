// Joints between two bodies, or between a body and a point in space, as constraints of a FemModel.
// A joint holds points of bodies (joint_point.h).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/fem/joint_coordinate.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/mesh/mesh.h"
#include "lib/ode/constraints.h"

namespace orthodyn {

// The course of a joint's coordinate in time, m(t) = amplitude factor(t), in m or rad.
struct JointMotor {
  double amplitude = 0;
  std::shared_ptr<const TimeFunction> factor;
  double value(double t) const { return amplitude * factor->value(t); }
  double rate(double t) const { return amplitude * factor->rate(t); }
  double curvature(double t) const { return amplitude * factor->curvature(t); }
};

// coincide: two points are one. distance: two points keep their distance at rest. across: the span from the second
// point to the first one stays at right angles to that from the second point to the third one. slide: the first point
// is the distance m(t) along this span. turn: as across, with a span that turns by m(t) from that to the third point
// towards that opposite to the fourth point. stretch: two points have their distance at rest plus m(t).
//
// All but `coincide` prescribe the product r . s of two spans, g = (r . s - r0 . s0) / length(): r from the second to
// the first point, and s from the second to the third one, which is the first one if the distance is kept.
//   slide: g = (r . s - r0 . s0) / length() - m(t)
//   turn: s = cos(m) s3 - sin(m) s4, with the spans from the second point to the third and the fourth one.
//   stretch: g = (r . r - r0 . r0) / (2 L) - m(t) - m(t)^2 / (2 L) with the distance L at rest: |r| = L + m(t).
struct JointEquation {
  enum class Kind { coincide, distance, across, slide, turn, stretch };
  static JointEquation coincide(JointPoint a, JointPoint b) { return {Kind::coincide, std::move(a), std::move(b), {}}; }
  static JointEquation distance(const JointPoint& a, JointPoint b) { return {Kind::distance, a, std::move(b), a}; }
  static JointEquation across(JointPoint a, JointPoint b, JointPoint c) {
    return {Kind::across, std::move(a), std::move(b), std::move(c)};
  }
  static JointEquation slide(JointPoint a, JointPoint b, JointPoint c, JointMotor motor) {
    return {Kind::slide, std::move(a), std::move(b), std::move(c), {}, std::move(motor)};
  }
  static JointEquation turn(JointPoint a, JointPoint b, JointPoint c, JointPoint d, JointMotor motor) {
    return {Kind::turn, std::move(a), std::move(b), std::move(c), std::move(d), std::move(motor)};
  }
  static JointEquation stretch(const JointPoint& a, JointPoint b, JointMotor motor) {
    return {Kind::stretch, a, std::move(b), a, {}, std::move(motor)};
  }

  Kind kind;
  JointPoint first, second, third, fourth = {};
  JointMotor motor = {};
  int size() const { return kind == Kind::coincide ? 3 : 1; }
  bool is_driven() const { return kind == Kind::slide || kind == Kind::turn || kind == Kind::stretch; }
  bool is_of_distance() const { return kind == Kind::distance || kind == Kind::stretch; }
  // The derivative of r . s by the first constraint's distance, m.
  double length() const { return (is_of_distance() ? 2 : 1) * (third.rest - second.rest).norm(); }
  // The derivative of g by the joint's coordinate at time t, of a driven joint: a number, or m per rad.
  double per_coordinate(double t) const;
};

struct Joint {
  enum class Of { bodies, rigid_body };  // joint of two bodies, or distances within a rigid body (rigid_body.h)

  std::string name;
  std::string place;  // in the input, for messages
  std::vector<JointEquation> equations;
  Of of = Of::bodies;
  std::optional<JointCoordinate> coordinate = {};         // along which springs, stops, friction, loads and motors act
  std::optional<JointCoordinate> slide = {}, angle = {};  // of cylindrical joints: the coordinate is one of them

  bool holds() const { return !equations.empty(); }  // false for struts
  bool bears_torque() const;                         // false for balls, slots, distances and struts
  const JointEquation* motor() const;                // null without a motor
  const JointCoordinate* turn() const;               // the angle between the bodies; null if the joint has none
};

}  // namespace orthodyn
