// Clamps and motions of a scene on its mesh: which coordinates are prescribed, how they move, and to which named
// supports they belong. In a static analysis, motions are at rest in their final position.
#pragma once

#include "lib/fem/fem_model.h"
#include "lib/scene/scene.h"

namespace orthodyn {

struct Supports {
  std::vector<bool> held;  // held[3 * node + component]
  std::vector<MovedNodes::Part> moved;
  std::vector<Support> named;  // empty unless the scene uses reactions
};

// A coordinate of several clamps belongs to the first. Throws ConfigError for a selection without nodes, a coordinate
// with two motions or with a clamp and a motion, a duplicate name, and a possible velocity jump with a consistent mass,
// which would need an infinite force.
Supports make_supports(const Scene& scene, const Mesh& mesh);

}  // namespace orthodyn
