// A place in a mesh, by the nodes of the element around it: what is known at nodes follows there by the element's
// shape functions.
#pragma once

#include <utility>
#include <vector>

#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

struct MeshPoint {
  std::vector<std::pair<int, double>> nodes;  // with their weights, which sum to 1
};

// The element is found by its corners. For a place outside of the body one at its surface, close by.
MeshPoint mesh_point(const TetMesh& mesh, const Vec3& place);

}  // namespace orthodyn
