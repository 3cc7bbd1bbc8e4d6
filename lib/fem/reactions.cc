#include "lib/fem/reactions.h"

namespace orthodyn {

namespace {

// Of all nodes as far as the inertia of held ones needs them.
NodalVector accelerations(const FemModel::Parts& parts, const NodalExpansion& nodal, const NodalVector& forces) {
  NodalVector a = parts.moved ? parts.moved->accelerations(nodal.time) : NodalVector::Zero(3, nodal.x.cols());
  if (parts.mass->lumped()) return a;  // the free ones do not couple with held ones
  Vector v(parts.dofs->num_dofs()), free(parts.dofs->num_dofs());
  parts.dofs->restrict_to(nodal.u_rate, v);
  free_forces(parts, nodal, v, forces, free);
  parts.mass->solve(free);
  parts.dofs->add_to(free, a);
  return a;
}

Vec3 on(const Support& support, const NodalVector& forces, std::size_t i) {
  Vec3 force = Vec3::Zero();
  for (int c = 0; c < 3; ++c)
    if (support.held[i][static_cast<std::size_t>(c)]) force[c] = forces(c, support.nodes[i]);
  return force;
}

}  // namespace

NodalVector support_forces(const FemModel::Parts& parts, const NodalExpansion& nodal) {
  const NodalVector f = term_forces(parts, nodal);
  const NodalVector a = accelerations(parts, nodal, f) + parts.mass_damping * nodal.u_rate;
  return held_part(*parts.dofs, parts.support_mass->times(a) - f);
}

Vec3 reaction(const Support& support, const NodalVector& forces) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < support.nodes.size(); ++i) sum += on(support, forces, i);
  return sum;
}

namespace {

Vec3 middle_of(const NodalVector& places, const Subdomain* subdomain) {
  Eigen::Vector4d sums(places.row(0).sum(), places.row(1).sum(), places.row(2).sum(),
                       static_cast<double>(places.cols()));
  if (subdomain) subdomain->ranks().sum({sums.data(), 4});
  return sums.head<3>() / sums[3];
}

}  // namespace

Vec3 reaction_torque(const Support& support, const NodalVector& forces, const NodalVector& x,
                     const Subdomain* subdomain) {
  const NodalVector places = x(Eigen::all, support.nodes);
  const Vec3 middle = middle_of(places, subdomain);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < support.nodes.size(); ++i)
    sum += (places.col(static_cast<Eigen::Index>(i)) - middle).cross(on(support, forces, i));
  return sum;
}

}  // namespace orthodyn
