// The section `joints`: connections of bodies by points that coincide or keep their distance (lib/fem/joints.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/fem/joints.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

// ball: one point of both bodies. hinge: two points, so that both bodies turn about the line through them. distance: a
// massless rod between a point of each body.
enum class JointType { ball, hinge, distance };

template <>
struct EnumNames<JointType> {
  static constexpr std::array<std::pair<JointType, const char*>, 3> list{
      {{JointType::ball, "ball"}, {JointType::hinge, "hinge"}, {JointType::distance, "distance"}}};
};

// The nodes of a body that a joint holds.
struct JointEnd : Selection {
  static const Spec<JointEnd>& spec();
};

struct JointInput {
  JointType type = JointType::ball;
  std::string name;
  std::optional<Vec3> at;        // m, of a ball
  std::optional<Vec3> from, to;  // m, ends of a hinge's pin or of a rod
  JointEnd first;
  std::optional<JointEnd> second;  // empty: a point in space
  SourceLocation origin;
  static const Spec<JointInput>& spec();

  // Throws ConfigError if a point cannot be held by the selected nodes.
  Joint on(const Mesh& mesh) const;
};

}  // namespace orthodyn
