// From the input's words for parts of the mesh to nodes and triangles.
#pragma once

#include <vector>

#include "lib/scene/scene.h"

namespace orthodyn {

// Throws ConfigError naming the mesh's surfaces if there is none of this name.
const std::vector<Triangle>& find_surface(const TetMesh& mesh, const std::string& name, const Origin& origin);

// clamped[3 * node + component]. Throws ConfigError for a selection without nodes.
std::vector<bool> clamped_coordinates(const std::vector<Clamp>& clamps, const TetMesh& mesh);

}  // namespace orthodyn
