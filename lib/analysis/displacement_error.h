// The error that the mesh makes in displacements of an equilibrium, by the dual problem (Becker & Rannacher 2001, Acta
// Numerica 10, 1): with z the response to a unit force at the node, the error of its displacement is a(u - u_h, z -
// z_h), and both factors are told by recovered stresses (lib/fem/stress_recovery.h).
#pragma once

#include <vector>

#include "lib/fem/fem_model.h"

namespace orthodyn {

// True less computed displacement at nodes of the mesh, m; zero along coordinates that are held. Throws RunError where
// the tangent cannot be factorised, or an iterative solver does not converge. Collective.
std::vector<Vec3> displacement_errors(const FemModel& model, const State& equilibrium, const std::vector<int>& nodes);

}  // namespace orthodyn
