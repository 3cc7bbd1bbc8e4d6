#include "lib/fem/terms/dead_load.h"

#include <fmt/format.h>

#include <cmath>

namespace orthodyn {

DeadLoad::DeadLoad(std::string name, NodalForces forces, std::shared_ptr<const TimeFunction> factor, std::string amount)
    : name_(std::move(name)), amount_(std::move(amount)), forces_(std::move(forces)), factor_(std::move(factor)) {}

std::string DeadLoad::description() const {
  const bool constant = factor_->constant();
  Vec3 sum = Vec3::Zero();
  double size = 0;
  for (const auto& [node, force] : forces_) sum += force, size += force.norm();
  if (constant) sum *= factor_->value(0);
  for (double& component : sum)
    if (std::abs(component) < 1e-12 * size) component = 0;  // round-off
  return fmt::format("{}: {}{}[{:.6g}, {:.6g}, {:.6g}] N in total{}", name_, amount_, amount_.empty() ? "" : ", ",
                     sum[0], sum[1], sum[2], constant ? "" : " at factor 1");
}

void DeadLoad::add_force(const NodalState& s, NodalVector& f) const {
  const double factor = factor_->value(s.t);
  for (const auto& [node, force] : forces_) f.col(node) += factor * force;
}

void DeadLoad::add_peak_force(const NodalState& s, double end, NodalVector& f) const {
  const double peak = factor_->peak(s.t, end);
  for (const auto& [node, force] : forces_) f.col(node) += peak * force;
}

double DeadLoad::load_power(const NodalState& s) const {
  double power = 0;
  for (const auto& [node, force] : forces_) power += force.dot(s.v.col(node));
  return factor_->value(s.t) * power;
}

std::vector<double> DeadLoad::breakpoints(double start, double end) const {
  return times_between(factor_->kinks(), start, end);
}

void declare_load(const TimeFunction& factor, Traits& traits) {
  traits.loaded = true;
  if (factor.constant()) return;
  traits.time_dependent = true;
  traits.conservative = false;
}

}  // namespace orthodyn
