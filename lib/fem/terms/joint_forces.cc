#include "lib/fem/terms/joint_forces.h"

#include <fmt/format.h>

#include <cmath>

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

class JointForces final : public Term {
 public:
  JointForces(std::string joint, JointCoordinate coordinate, const JointLaw& law, const BlockPattern& pattern)
      : joint_(std::move(joint)),
        coordinate_(std::move(coordinate)),
        nodes_(coordinate_),
        law_(law),
        pattern_(pattern) {}

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
    nodes_.add_force(law_.force(at.value) + law_.resistance(coordinate_.rate(s.u, s.v)), at, f);
  }

  bool has_mean_force() const override { return false; }

  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double* damping) const override {
    const auto at = coordinate_.expand(s.u);
    const double rate = coordinate_.rate(s.u, s.v);
    const double force = kind == TangentKind::gauss_newton ? 0 : law_.force(at.value) + law_.resistance(rate);
    nodes_.add_tangent(law_.stiffness(at.value), force, at, pattern_, stiffness);
    if (damping && law_.dissipates()) nodes_.add_tangent(law_.damping(rate), 0, at, pattern_, damping);
  }

  EnergyKind energy_kind() const override { return EnergyKind::elastic; }
  double energy(const NodalState& s) const override { return law_.energy(coordinate_.value(s.u)); }
  double dissipation(const NodalState& s) const override {
    const double rate = coordinate_.rate(s.u, s.v);
    return -rate * law_.resistance(rate);
  }

 private:
  std::string joint_;
  JointCoordinate coordinate_;
  CoordinateNodes nodes_;
  JointLaw law_;
  const BlockPattern& pattern_;
};

}  // namespace

std::unique_ptr<Term> joint_forces_term(std::string joint, JointCoordinate coordinate, const JointLaw& law,
                                        const BlockPattern& pattern) {
  return std::make_unique<JointForces>(std::move(joint), std::move(coordinate), law, pattern);
}

}  // namespace orthodyn
