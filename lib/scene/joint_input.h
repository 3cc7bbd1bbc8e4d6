// The section `joints`: connections of bodies by points that coincide or keep their distance (lib/fem/joints.h), or
// between which forces act.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/quantity_value.h"
#include "lib/fem/joints.h"
#include "lib/fem/rigid_body.h"
#include "lib/fem/terms/joint_forces.h"
#include "lib/mesh/selection.h"
#include "lib/ode/model.h"

namespace orthodyn {

// ball: one point of both bodies. fixed: a point, and neither body turns against the other one. hinge: two points, so
// that both bodies turn about the line through them. distance: a massless rod between a point of each body. slot: a
// point of the first body stays on a line of the second one. cylindrical: two points stay on the line. slider: they do,
// and the first body does not turn about it. strut: holds nothing; forces act between a point of each body.
enum class JointType { ball, hinge, distance, slot, cylindrical, slider, fixed, strut };

template <>
struct EnumNames<JointType> {
  static constexpr std::array<std::pair<JointType, const char*>, 8> list{{{JointType::ball, "ball"},
                                                                          {JointType::hinge, "hinge"},
                                                                          {JointType::distance, "distance"},
                                                                          {JointType::slot, "slot"},
                                                                          {JointType::cylindrical, "cylindrical"},
                                                                          {JointType::slider, "slider"},
                                                                          {JointType::fixed, "fixed"},
                                                                          {JointType::strut, "strut"}}};
};

// The coordinate of a cylindrical joint along which forces and motors act.
enum class JointFreedom { slide, turn };

template <>
struct EnumNames<JointFreedom> {
  static constexpr std::array<std::pair<JointFreedom, const char*>, 2> list{
      {{JointFreedom::slide, "slide"}, {JointFreedom::turn, "turn"}}};
};

// The nodes of a body that a joint holds.
struct JointEnd : Selection {
  static const Spec<JointEnd>& spec();
};

// Spring, stops, friction, load and motor of a joint along its coordinate: lib/fem/terms/joint_forces.h and
// joint_load.h, JointMotor. Values in m and N, or in rad and N m.
struct JointSpring {
  double stiffness = 0, damping = 0;
  QuantityValue rest;
  static const Spec<JointSpring>& spec();
};
struct JointStop {
  std::optional<QuantityValue> low, high, onset;
  double stiffness = 0;
  static const Spec<JointStop>& spec();
};
struct JointFriction {
  double limit = 0;
  std::optional<double> creep;
  static const Spec<JointFriction>& spec();
};
struct JointLoading {
  QuantityValue amount;
  std::shared_ptr<const TimeFunction> factor;
  static const Spec<JointLoading>& spec();
};
struct JointDrive {
  QuantityValue to;
  std::shared_ptr<const TimeFunction> factor;
  SourceLocation origin;
  static const Spec<JointDrive>& spec();
};

struct JointInput {
  JointType type = JointType::ball;
  std::string name;
  std::optional<Vec3> at;        // m, of a ball or fixed joint
  std::optional<Vec3> from, to;  // m, ends of a hinge's pin, of a rod or strut, or two points of a line
  JointEnd first;
  std::optional<JointEnd> second;     // empty: a point in space
  std::optional<JointFreedom> along;  // of a cylindrical joint; empty: slide
  std::optional<JointSpring> spring;
  std::optional<JointStop> stop;
  std::optional<JointFriction> friction;
  std::optional<JointLoading> load;
  std::optional<JointDrive> motor;
  SourceLocation origin;
  static const Spec<JointInput>& spec();

  bool is_at_a_point() const { return type == JointType::ball || type == JointType::fixed; }
  // Whether the coordinate is an angle, a distance along a line, or the change of a distance of two points.
  bool turns() const {
    return type == JointType::hinge || (type == JointType::cylindrical && along == JointFreedom::turn);
  }
  bool slides() const {
    return type == JointType::slot || type == JointType::slider || (type == JointType::cylindrical && !turns());
  }
  bool stretches() const { return type == JointType::distance || type == JointType::strut; }
  bool may_have_forces() const { return turns() || slides() || type == JointType::strut; }
  bool may_have_motor() const { return turns() || slides() || type == JointType::distance; }
  JointLaw law() const;
  // Whether a spring, stop, friction or load acts along the coordinate. A motor is a constraint and does not count.
  bool has_forces() const { return load || law().acts(); }
  void declare(Traits& traits) const;

  // From `start` to `end` (s). Nodes of a rigid body hold any point. Throws ConfigError if a point cannot be held
  // by the selected nodes.
  Joint on(const Mesh& mesh, const std::vector<RigidBody>& rigid, double start, double end) const;
};

}  // namespace orthodyn
