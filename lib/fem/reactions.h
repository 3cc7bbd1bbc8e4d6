// What the surroundings exert on held and moved nodes: r = M a + alpha M v - f at their coordinates, where f are
// the forces of all terms, a the accelerations of all nodes and alpha the mass-proportional damping.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lib/fem/fem_model.h"

namespace orthodyn {

// N, zero for free coordinates.
NodalVector support_forces(const FemModel::Parts& parts, const NodalExpansion& nodal);

// Of support_forces(), those on one support: their sum, N, and their torque about the middle of its nodes as
// they are now, N m.
Vec3 reaction(const Support& support, const NodalVector& forces);
Vec3 reaction_torque(const Support& support, const NodalVector& forces, const NodalVector& x,
                     const Subdomain* subdomain = nullptr);

}  // namespace orthodyn
