// Estimates the discretisation error of nodal displacements in equilibrium by the dual problem (Becker & Rannacher
// 2001, Acta Numerica 10, 1). The error at a node is a(u - u_h, z - z_h), where a is the bilinear form of the elastic
// energy, u and u_h are the exact and computed displacements, and z and z_h the exact and computed responses to a unit
// force at the node. Both differences are estimated from recovered stresses (lib/fem/stress_recovery.h).
#pragma once

#include <vector>

#include "lib/fem/fem_model.h"

namespace orthodyn {

// Estimates the exact minus the computed displacement (m) at the given nodes of the mesh; zero for held coordinates.
// Throws RunError if the tangent cannot be factorised or an iterative solver does not converge. Collective.
std::vector<Vec3> displacement_errors(const FemModel& model, const State& equilibrium, const std::vector<int>& nodes);

}  // namespace orthodyn
