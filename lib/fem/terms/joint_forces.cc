#include "lib/fem/terms/joint_forces.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "lib/fem/contact/penalty.h"

namespace orthodyn {

double JointLaw::energy(double c) const {
  double sum = 0;
  if (spring) sum += spring->stiffness / 2 * (c - spring->rest) * (c - spring->rest);
  if (stop && stop->high) sum += stop->stiffness * penalty(c - *stop->high, stop->onset);
  if (stop && stop->low) sum += stop->stiffness * penalty(*stop->low - c, stop->onset);
  return sum;
}

double JointLaw::force(double c) const {
  double sum = 0;
  if (spring) sum -= spring->stiffness * (c - spring->rest);
  if (stop && stop->high) sum -= stop->stiffness * penalty_slope(c - *stop->high, stop->onset);
  if (stop && stop->low) sum += stop->stiffness * penalty_slope(*stop->low - c, stop->onset);
  return sum;
}

double JointLaw::stiffness(double c) const {
  double sum = 0;
  if (spring) sum += spring->stiffness;
  if (stop && stop->high) sum += stop->stiffness * penalty_curvature(c - *stop->high, stop->onset);
  if (stop && stop->low) sum += stop->stiffness * penalty_curvature(*stop->low - c, stop->onset);
  return sum;
}

double JointLaw::resistance(double rate) const {
  double sum = 0;
  if (spring) sum -= spring->damping * rate;
  if (friction) sum -= friction->limit * rate / std::hypot(rate, friction->creep);
  return sum;
}

double JointLaw::damping(double rate) const {
  double sum = 0;
  if (spring) sum += spring->damping;
  if (friction) sum += friction->limit * std::pow(friction->creep, 2) / std::pow(std::hypot(rate, friction->creep), 3);
  return sum;
}

namespace {

std::set<int> nodes_of(const JointCoordinate& coordinate) {
  std::set<int> nodes;
  for (const JointPoint& point : coordinate.points())
    for (const auto& [node, weight] : point.weights) nodes.insert(node);
  return nodes;
}

class JointForces final : public Term {
 public:
  JointForces(std::string joint, JointCoordinate coordinate, const JointLaw& law, const BlockPattern& pattern)
      : joint_(std::move(joint)), coordinate_(std::move(coordinate)), law_(law), pattern_(pattern) {
    for (const int node : nodes_of(coordinate_)) {
      Vector weights = Vector::Zero(std::ssize(coordinate_.points()));
      for (std::size_t p = 0; p < coordinate_.points().size(); ++p)
        for (const auto& [of, weight] : coordinate_.points()[p].weights)
          if (of == node) weights[static_cast<Eigen::Index>(p)] += weight;
      nodes_.push_back({node, std::move(weights)});
    }
  }

  std::string name() const override { return "forces of joint " + joint_; }
  std::string description() const override {
    std::string kinds;
    const auto add = [&](bool has, const char* kind) {
      if (has) kinds += (kinds.empty() ? "" : ", ") + std::string(kind);
    };
    add(law_.spring.has_value(), "spring");
    add(law_.stop.has_value(), "stop");
    add(law_.friction.has_value(), "friction");
    return fmt::format("joint {}: {}", joint_, kinds);
  }

  void add_force(const NodalState& s, NodalVector& f) const override {
    const auto at = coordinate_.expand(s.u);
    const double force = law_.force(at.value) + law_.resistance(coordinate_.rate(s.u, s.v));
    for (const Node& node : nodes_) f.col(node.index) += force * slope(node, at.slope);
  }

  bool has_mean_force() const override { return false; }

  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double* damping) const override {
    const auto at = coordinate_.expand(s.u);
    const double rate = coordinate_.rate(s.u, s.v), along = law_.stiffness(at.value), against = law_.damping(rate);
    double force = law_.force(at.value) + law_.resistance(rate);
    if (kind == TangentKind::gauss_newton) force = 0;
    for (const Node& a : nodes_)
      for (const Node& b : nodes_) {
        if (pattern_.symmetric() && a.index < b.index) continue;
        const Mat3 outer = slope(a, at.slope) * slope(b, at.slope).transpose();
        Mat3 block = along * outer;
        if (force != 0) block -= force * curvature(a, b, at.curvature);
        const int offset = pattern_.offset(a.index, b.index);
        pattern_.add(a.index, b.index, offset, block, stiffness);
        if (damping && law_.dissipates()) pattern_.add(a.index, b.index, offset, against * outer, damping);
      }
  }

  EnergyKind energy_kind() const override { return EnergyKind::elastic; }
  double energy(const NodalState& s) const override { return law_.energy(coordinate_.value(s.u)); }
  double dissipation(const NodalState& s) const override {
    const double rate = coordinate_.rate(s.u, s.v);
    return -rate * law_.resistance(rate);
  }

 private:
  struct Node {
    int index;
    Vector weights;  // in each point of the coordinate
  };

  static Vec3 slope(const Node& node, const Vector& of_points) {
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index p = 0; p < node.weights.size(); ++p) sum += node.weights[p] * of_points.segment<3>(3 * p);
    return sum;
  }

  static Mat3 curvature(const Node& a, const Node& b, const Eigen::MatrixXd& of_points) {
    Mat3 sum = Mat3::Zero();
    for (Eigen::Index p = 0; p < a.weights.size(); ++p)
      for (Eigen::Index r = 0; r < b.weights.size(); ++r)
        sum += a.weights[p] * b.weights[r] * of_points.block<3, 3>(3 * p, 3 * r);
    return sum;
  }

  std::string joint_;
  JointCoordinate coordinate_;
  JointLaw law_;
  const BlockPattern& pattern_;
  std::vector<Node> nodes_;
};

}  // namespace

NodePairs joint_couplings(const JointCoordinate& coordinate) {
  const std::set<int> nodes = nodes_of(coordinate);
  NodePairs pairs;
  for (auto a = nodes.begin(); a != nodes.end(); ++a)
    for (auto b = nodes.begin(); b != a; ++b) pairs.emplace_back(*a, *b);
  return pairs;
}

std::unique_ptr<Term> joint_forces_term(std::string joint, JointCoordinate coordinate, const JointLaw& law,
                                        const BlockPattern& pattern) {
  return std::make_unique<JointForces>(std::move(joint), std::move(coordinate), law, pattern);
}

}  // namespace orthodyn
