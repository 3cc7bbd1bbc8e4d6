#include "lib/scene/initial_state.h"

#include <random>

namespace orthodyn {

namespace {

// Uniform in [-1, 1), the same on every platform.
double symmetric_uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-52 - 1;
}

Vec3 at(const std::array<PointFormula, 3>& field, const Vec3& x) { return {field[0].at(x), field[1].at(x), field[2].at(x)}; }

Vec3 center_of_mass(const FemModel::Parts& parts) {
  return *parts.rest * parts.mass->nodal() / parts.mass->total();
}

// Of each node, for a body displaced by u.
NodalVector initial_velocity(const Initial& initial, const FemModel::Parts& parts, const NodalVector& u) {
  const Vec3 center = initial.center.value_or(center_of_mass(parts));
  NodalVector v(3, u.cols());
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const Vec3 arm = parts.rest->col(i) + u.col(i) - center;
    v.col(i) = initial.velocity + initial.spin.cross(arm);
    if (initial.velocity_field) v.col(i) += at(*initial.velocity_field, parts.rest->col(i));
  }
  return v;
}

}  // namespace

State initial_state(const Scene& scene, const FemModel::Parts& parts) {
  const int n = parts.dofs->num_dofs();
  State state{scene.time.start, Vector::Zero(n), Vector::Zero(n)};
  if (!scene.initial) return state;
  const Initial& initial = *scene.initial;
  const Vec3 center = initial.center.value_or(center_of_mass(parts));
  const Mat3 F = initial.deformation_gradient.value_or(Mat3::Identity());
  NodalVector u = (F - Mat3::Identity()) * (parts.rest->colwise() - center);
  if (initial.displacement_field)
    for (Eigen::Index i = 0; i < u.cols(); ++i) u.col(i) += at(*initial.displacement_field, parts.rest->col(i));
  if (initial.noise) {
    std::mt19937_64 generator(static_cast<std::uint64_t>(initial.noise->seed));
    for (double& x : u.reshaped()) x += initial.noise->amplitude * symmetric_uniform(generator);
  }
  parts.dofs->restrict_to(u, state.q);
  parts.dofs->restrict_to(initial_velocity(initial, parts, u), state.v);
  return state;
}

State initial_state_at(const Vector& q, const Scene& scene, const FemModel::Parts& parts) {
  State state{scene.time.start, q, Vector::Zero(q.size())};
  if (!scene.initial) return state;
  NodalVector u = NodalVector::Zero(3, parts.rest->cols());
  parts.dofs->add_to(q, u);
  parts.dofs->restrict_to(initial_velocity(*scene.initial, parts, u), state.v);
  return state;
}

}  // namespace orthodyn
