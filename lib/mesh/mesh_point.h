// A point of a mesh as a weighted sum of nodes: the shape functions of the element that contains it.
#pragma once

#include <utility>
#include <vector>

#include "lib/mesh/mesh.h"

namespace orthodyn {

struct MeshPoint {
  std::vector<std::pair<int, double>> nodes;  // nodes and their weights, which sum to 1
};

// The point at `place` (m) in the rest shape. Elements are located by their corners. For a place outside the body, a
// nearby point on its surface.
MeshPoint mesh_point(const Mesh& mesh, const Vec3& place);

}  // namespace orthodyn
