// The state at the start: uniform deformation about the centre, noise, then rigid motion.
#pragma once

#include "lib/fem/fem_model.h"
#include "lib/scene/scene.h"

namespace orthodyn {

State initial_state(const Scene& scene, const FemModel::Parts& parts);

}  // namespace orthodyn
