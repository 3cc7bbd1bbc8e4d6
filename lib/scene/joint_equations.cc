// The equations of a joint in the input.

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "lib/scene/joint_input.h"

namespace orthodyn {

namespace {

// The root mean square distance of nodes from their mean, the two directions in which they spread most, and how much
// they spread along the third one, relative to their size.
struct Spread {
  double size;  // m
  Vec3 first, second;
  double third;
};

Spread spread_of(const Mesh& mesh, const std::vector<int>& nodes) {
  Eigen::Matrix3Xd x(3, std::ssize(nodes));
  for (std::size_t k = 0; k < nodes.size(); ++k) x.col(static_cast<Eigen::Index>(k)) = mesh.node(nodes[k]);
  x.colwise() -= Vec3(x.rowwise().mean());
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(x * x.transpose());
  return {x.norm() / std::sqrt(static_cast<double>(x.cols())), eigen.eigenvectors().col(2), eigen.eigenvectors().col(1),
          std::sqrt(std::max(eigen.eigenvalues()[0], 0.0)) / x.norm()};
}

// The points of the two bodies of a joint.
class Ends {
 public:
  Ends(const JointInput& joint, const Mesh& mesh, const std::vector<RigidBody>& rigid) : joint_(joint), mesh_(mesh) {
    first_ = end_of(joint.first, rigid);
    if (joint.second) second_ = end_of(*joint.second, rigid);
  }

  bool are_rigid() const { return first_.body && (!joint_.second || second_.body); }
  bool first_can_hold(const Vec3& point) const { return !found(first_, point).weights.empty(); }
  // The direction, at right angles to the line, in which a node of the first body is farthest from it; zero without
  // any.
  Vec3 first_beside(const Vec3& from, const Vec3& direction) const {
    Vec3 farthest = Vec3::Zero();
    for (const int node : first_.nodes) {
      const Vec3 r = mesh_.node(node) - from, across = r - direction * direction.dot(r);
      if (across.norm() > farthest.norm()) farthest = across;
    }
    return farthest.stableNormalized();
  }
  bool second_can_hold(const Vec3& point) const { return !joint_.second || !found(second_, point).weights.empty(); }

  // Of the nodes of the deformable end that is more nearly plane, or of the first body.
  Spread spread() const {
    std::optional<Spread> flattest;
    for (const auto& [end, given] : {std::pair(&first_, &joint_.first), std::pair(&second_, second_given())}) {
      if (!given || (end->body && !are_rigid())) continue;
      const Spread spread = spread_of(mesh_, end->body ? end->body->nodes() : end->nodes);
      if (spread.size == 0) given->origin.fail("one node cannot hold directions; select more nodes of the body");
      if (!flattest || (!end->body && spread.third < flattest->third)) flattest = spread;
    }
    return *flattest;
  }

  JointPoint first(const Vec3& point) const { return held(joint_.first, first_, point); }
  JointPoint second(const Vec3& point) const {
    return joint_.second ? held(*joint_.second, second_, point) : JointPoint{{}, point};
  }

 private:
  struct End {
    std::vector<int> nodes;
    const RigidBody* body = nullptr;  // that has all the nodes; null for none
  };

  End end_of(const JointEnd& end, const std::vector<RigidBody>& rigid) const {
    End out{selected_nodes(end, mesh_)};
    for (const RigidBody& body : rigid)
      if (body.contains(out.nodes)) out.body = &body;
    return out;
  }

  const JointEnd* second_given() const { return joint_.second ? &*joint_.second : nullptr; }

  JointPoint found(const End& end, const Vec3& point) const {
    return end.body ? end.body->point(mesh_, point) : joint_point(mesh_, end.nodes, point);
  }

  JointPoint held(const JointEnd& given, const End& end, const Vec3& point) const {
    JointPoint out = found(end, point);
    if (out.weights.empty())
      given.origin.fail(fmt::format(
          "the {} selected node{} cannot hold the point [{:.6g}, {:.6g}, {:.6g}]: nodes of a plane hold points of this "
          "plane, a node holds its own place only; move the point, or select nodes on all sides of it",
          end.nodes.size(), end.nodes.size() == 1 ? "" : "s", point[0], point[1], point[2]));
    return out;
  }

  const JointInput& joint_;
  const Mesh& mesh_;
  End first_, second_;
};

// The joint's line and two directions at right angles to it and to each other, as long as the line.
struct Directions {
  Vec3 line, side, other;
};

// The side of nodes in a plane with the line lies in this plane, which the first body can hold.
Directions directions(const JointInput& joint, const Ends& ends) {
  const Vec3 line = *joint.to - *joint.from;
  Vec3 side = line.unitOrthogonal();
  if (!ends.first_can_hold(*joint.from + line.norm() * side))
    if (const Vec3 of_nodes = ends.first_beside(*joint.from, line.normalized()); !of_nodes.isZero(0)) side = of_nodes;
  return {line, line.norm() * side, line.cross(side)};
}

JointCoordinate turning(const JointInput& joint, const Ends& ends) {
  const Vec3 from = *joint.from;
  const auto [line, side, other] = directions(joint, ends);
  return JointCoordinate::turning(ends.first(from), ends.first(from + side), ends.second(from),
                                  ends.second(from + side), ends.second(from + other));
}

// Two points coincide. Two rigid bodies keep the distance of both points by themselves: then the second point is held
// across the line only.
void add_hinge(const JointInput& joint, const Ends& ends, Joint& out) {
  const Vec3 from = *joint.from, to = *joint.to;
  const auto [line, side, other] = directions(joint, ends);
  const auto coincide = [&](const Vec3& x) { return JointEquation::coincide(ends.first(x), ends.second(x)); };
  const auto across = [&](const Vec3& offset) {
    return JointEquation::across(ends.first(to), ends.second(from), ends.second(from + offset));
  };
  if (ends.are_rigid()) out.equations = {coincide(from), across(side), across(other)};
  else out.equations = {coincide(from), coincide(to)};
  const bool is_used = joint.motor || joint.has_forces();
  const bool has_angle =
      ends.first_can_hold(from + side) && ends.second_can_hold(from + side) && ends.second_can_hold(from + other);
  if (is_used || has_angle) out.coordinate = turning(joint, ends);
}

void add_slide(const JointInput& joint, const Ends& ends, Joint& out) {
  const Vec3 from = *joint.from;
  const auto [line, side, other] = directions(joint, ends);
  // `from + along` and `from + offset` are points of the first and of the second body.
  const auto across = [&](const Vec3& along, const Vec3& offset) {
    return JointEquation::across(ends.first(from + along), ends.second(from), ends.second(from + offset));
  };
  const Vec3 here = Vec3::Zero();
  out.equations = {across(here, side), across(here, other)};
  if (joint.type != JointType::slot) {
    out.equations.push_back(across(line, side));
    out.equations.push_back(across(line, other));
  }
  if (joint.type == JointType::slider) out.equations.push_back(across(side, other));
  const JointCoordinate slide = JointCoordinate::sliding(ends.first(from), ends.second(from), ends.second(*joint.to));
  out.coordinate = slide;
  if (joint.type != JointType::cylindrical) return;
  out.slide = slide;
  if (joint.turns() || ends.first_can_hold(from + side)) out.angle = turning(joint, ends);
  if (joint.turns()) out.coordinate = out.angle;
}

// The points of a strut, or of a rod whose length a motor prescribes. A rod without a motor has no coordinate.
void add_stretch(const JointInput& joint, const Ends& ends, Joint& out) {
  const JointPoint first = ends.first(*joint.from), second = ends.second(*joint.to);
  if (joint.type == JointType::distance && !joint.motor) out.equations = {JointEquation::distance(first, second)};
  else out.coordinate = JointCoordinate::stretching(first, second);
}

// Two rigid bodies share a point, and three pairs of their directions stay at right angles. Other bodies share three
// points of the plane in which the nodes of a deformable one spread most.
void add_fixed(const JointInput& joint, const Ends& ends, Joint& out) {
  const Vec3 at = *joint.at;
  const auto coincide = [&](const Vec3& x) { return JointEquation::coincide(ends.first(x), ends.second(x)); };
  const Spread spread = ends.spread();
  const double size = spread.size;
  const Vec3 &a = spread.first, &b = spread.second;
  out.equations = {coincide(at)};
  if (!ends.are_rigid()) {
    out.equations.push_back(coincide(at + size * a));
    out.equations.push_back(coincide(at + size * b));
    return;
  }
  const Vec3 c = a.cross(b);
  for (const auto& [of_first, of_second] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
    out.equations.push_back(
        JointEquation::across(ends.first(at + size * of_first), ends.second(at), ends.second(at + size * of_second)));
}

// Refuses a course in which the points of a distance meet.
void require_distance(const JointInput& joint, const JointMotor& motor, double start, double end) {
  constexpr int kSamples = 1000;
  const double length = (*joint.to - *joint.from).norm();
  for (int k = 0; k <= kSamples; ++k) {
    const double t = start + (end - start) * k / kSamples, changed = length + motor.value(t);
    if (!(changed > 0))
      joint.motor->origin.fail(
          fmt::format("the distance of `from` and `to`, {:.4g} m at rest, would be {:.4g} m at t "
                      "= {:.4g} s; it must stay above 0: `to` is the change of the distance",
                      length, changed, t));
  }
}

JointEquation driven(const JointInput& joint, const Ends& ends, JointMotor motor) {
  const Vec3 from = *joint.from;
  if (joint.stretches()) return JointEquation::stretch(ends.first(from), ends.second(*joint.to), std::move(motor));
  if (joint.slides())
    return JointEquation::slide(ends.first(from), ends.second(from), ends.second(*joint.to), std::move(motor));
  const auto [line, side, other] = directions(joint, ends);
  return JointEquation::turn(ends.first(from + side), ends.second(from), ends.second(from + other),
                             ends.second(from + side), std::move(motor));
}

}  // namespace

Joint JointInput::on(const Mesh& mesh, const std::vector<RigidBody>& rigid, double start, double end) const {
  const Ends ends(*this, mesh, rigid);
  Joint joint{name, origin.where, {}};
  if (type == JointType::ball) joint.equations = {JointEquation::coincide(ends.first(*at), ends.second(*at))};
  else if (type == JointType::fixed) add_fixed(*this, ends, joint);
  else if (type == JointType::hinge) add_hinge(*this, ends, joint);
  else if (stretches()) add_stretch(*this, ends, joint);
  else add_slide(*this, ends, joint);
  if (motor) {
    const auto resolved = motor->factor->over(start, end);
    const JointMotor course{motor->to, resolved ? resolved : motor->factor};
    if (stretches()) require_distance(*this, course, start, end);
    joint.equations.push_back(driven(*this, ends, course));
  }
  return joint;
}

}  // namespace orthodyn
