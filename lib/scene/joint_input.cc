#include "lib/scene/joint_input.h"

#include <fmt/format.h>

namespace orthodyn {

const Spec<JointEnd>& JointEnd::spec() {
  static const auto s =
      selection_spec<JointEnd>().check([](const JointEnd& end, const Config& config) { end.check(config); });
  return s;
}

namespace {

void check_joint(const JointInput& joint, const Config& config) {
  const bool is_ball = joint.type == JointType::ball;
  if (is_ball && !joint.at) config.fail("a ball joint needs `at`, the point of both bodies");
  if (is_ball && (joint.from || joint.to)) config.fail("a ball joint has no `from` and `to`; give `at`");
  if (!is_ball && joint.at) config.at("at").fail("is for ball joints; give `from` and `to`");
  if (!is_ball && (!joint.from || !joint.to))
    config.fail(joint.type == JointType::hinge ? "a hinge needs `from` and `to`, the ends of its pin"
                : joint.type == JointType::distance
                    ? "a distance needs `from`, on the first body, and `to`, on the second"
                    : "needs `from` and `to`, two points of the line along which the first body slides");
  if (!is_ball && (*joint.from - *joint.to).norm() == 0) config.at("to").fail("is the same point as `from`");
}

}  // namespace

const Spec<JointInput>& JointInput::spec() {
  using J = JointInput;
  static const auto s =
      Spec<J>()
          .key(
              "type", &J::type,
              "ball: a point of both bodies; hinge: two points, the ends of a pin; distance: a massless rod; slot: the "
              "point `from` of the first body stays on the line of the second one through `from` and `to`; "
              "cylindrical: "
              "both points of the first body stay on this line; slider: they do, and the bodies do not turn about it.",
              {.required = true})
          .key("name", &J::name, "Name of the outputs, such as joint.NAME.", {.required = true})
          .key("at", &J::at, "The point of a ball joint.", {.unit = "m"})
          .key("from", &J::from,
               "First end of the pin of a hinge, of the rod, on the first body, or of the line of a slot or slider.",
               {.unit = "m"})
          .key("to", &J::to, "Second end of the pin of a hinge, of the rod, on the second body, or of the line.",
               {.unit = "m"})
          .key("first", &J::first, "Nodes of the first body that hold the joint.", {.required = true})
          .key("second", &J::second, "Nodes of the second body that hold the joint; default: a point fixed in space.")
          .check(check_joint);
  return s;
}

Joint JointInput::on(const Mesh& mesh, const std::vector<RigidBody>& rigid) const {
  const auto held = [&](const JointEnd& end, const Vec3& point) {
    const std::vector<int> nodes = selected_nodes(end, mesh);
    for (const RigidBody& body : rigid)
      if (body.contains(nodes)) return body.point(mesh, point);
    JointPoint found = joint_point(mesh, nodes, point);
    if (found.weights.empty())
      end.origin.fail(fmt::format(
          "the {} selected node{} cannot hold the point [{:.6g}, {:.6g}, {:.6g}]: nodes of a plane hold points of this "
          "plane, a node holds its own place only; move the point, or select nodes on all sides of it",
          nodes.size(), nodes.size() == 1 ? "" : "s", point[0], point[1], point[2]));
    return found;
  };
  const auto of_second = [&](const Vec3& point) { return second ? held(*second, point) : JointPoint{{}, point}; };
  const auto coincide = [&](const Vec3& point) {
    return JointEquation::coincide(held(first, point), of_second(point));
  };
  // `from + along` and `from + offset` are points of the first and of the second body.
  const auto across = [&](const Vec3& along, const Vec3& offset) {
    return JointEquation::across(held(first, *from + along), of_second(*from), of_second(*from + offset));
  };
  switch (type) {
    case JointType::ball: return {name, origin.where, {coincide(*at)}};
    case JointType::hinge: return {name, origin.where, {coincide(*from), coincide(*to)}};
    case JointType::distance:
      return {name, origin.where, {JointEquation::distance(held(first, *from), of_second(*to))}};
    default: break;
  }
  const Vec3 line = *to - *from, side = line.norm() * line.unitOrthogonal(), other = line.normalized().cross(side);
  const Vec3 start = Vec3::Zero();
  Joint joint{name, origin.where, {across(start, side), across(start, other)}};
  if (type == JointType::slot) return joint;
  joint.equations.push_back(across(line, side));
  joint.equations.push_back(across(line, other));
  if (type == JointType::slider) joint.equations.push_back(across(side, other));
  return joint;
}

}  // namespace orthodyn
