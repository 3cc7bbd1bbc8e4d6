#include "lib/fem/dead_load.h"

#include <map>

namespace orthodyn {

namespace {

double area(const TetMesh& mesh, const Triangle& t) {
  const auto& x = [&](std::size_t k) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(t[k])]; };
  return 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm();
}

}  // namespace

std::vector<double> times_between(const std::vector<double>& all, double start, double end) {
  std::vector<double> times;
  for (const double t : all)
    if (t > start && t < end) times.push_back(t);
  return times;
}

double surface_area(const TetMesh& mesh, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += area(mesh, t);
  return sum;
}

DeadLoad::NodalForces surface_forces(const TetMesh& mesh, const std::vector<Triangle>& triangles,
                                     const Vec3& traction) {
  std::map<int, Vec3> sums;
  for (const auto& t : triangles)
    for (const int node : t) sums.try_emplace(node, Vec3::Zero()).first->second += area(mesh, t) / 3 * traction;
  return {sums.begin(), sums.end()};
}

DeadLoad::DeadLoad(std::string description, NodalForces forces, std::shared_ptr<const TimeFunction> factor)
    : description_(std::move(description)), forces_(std::move(forces)), factor_(std::move(factor)) {}

void DeadLoad::add_force(const NodalState& s, NodalVector& f) const {
  const double factor = factor_->value(s.t);
  for (const auto& [node, force] : forces_) f.col(node) += factor * force;
}

void DeadLoad::add_peak_force(const NodalState&, NodalVector& f) const {
  for (const auto& [node, force] : forces_) f.col(node) += factor_->peak() * force;
}

double DeadLoad::load_power(const NodalState& s) const {
  double power = 0;
  for (const auto& [node, force] : forces_) power += force.dot(s.v.col(node));
  return factor_->value(s.t) * power;
}

std::vector<double> DeadLoad::breakpoints(double start, double end) const {
  return times_between(factor_->kinks(), start, end);
}

}  // namespace orthodyn
