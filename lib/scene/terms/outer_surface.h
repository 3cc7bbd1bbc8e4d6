// The triangles that a term acts on: those of a named surface, or all outer faces of the body.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/scene/selection.h"

namespace orthodyn {

inline std::vector<Triangle> surface_or_all(const TetMesh& mesh, const std::optional<std::string>& name,
                                            const Origin& origin) {
  return name ? find_surface(mesh, *name, origin) : boundary_triangles(mesh);
}

}  // namespace orthodyn
