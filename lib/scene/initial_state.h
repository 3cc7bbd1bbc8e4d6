// The state at the start: uniform deformation about the centre, noise, then rigid motion.
#pragma once

#include "lib/fem/fem_model.h"
#include "lib/scene/scene.h"

namespace orthodyn {

State initial_state(const Scene& scene, const FemModel::Parts& parts);

// The same velocities, of a body whose free coordinates are at q.
State initial_state_at(const Vector& q, const Scene& scene, const FemModel::Parts& parts);

}  // namespace orthodyn
