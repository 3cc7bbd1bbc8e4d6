// Refinement of a scene's mesh by its keys.
#pragma once

#include "lib/config/config.h"

namespace orthodyn {

// Divides the size of the cells by 2^levels: `mesh.cells` times 2^levels, or for a mesh from a file `mesh.refine` +
// levels. Throws ConfigError for a mesh that has neither.
void refine_mesh(Config& scene, int levels);

}  // namespace orthodyn
