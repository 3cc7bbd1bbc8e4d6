// The clamps and motions of a scene on its mesh: which coordinates are no unknowns, how they move, and which of
// them belong to which name. In a static analysis they stand still where their motion has brought them.
#pragma once

#include "lib/fem/fem_model.h"
#include "lib/scene/scene.h"

namespace orthodyn {

struct Supports {
  std::vector<bool> held;  // held[3 * node + component]
  std::vector<MovedNodes::Part> moved;
  std::vector<Support> named;  // only where the scene wants reactions
};

// A coordinate of several clamps belongs to the first of them. Throws ConfigError for a selection without nodes, a
// coordinate that is moved twice or held and moved, a name that is used twice, and a jump of velocity that a
// consistent mass would answer by an infinite force.
Supports make_supports(const Scene& scene, const TetMesh& mesh);

}  // namespace orthodyn
