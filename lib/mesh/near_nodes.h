// The nodes of a mesh, to be found by their places at rest.
#pragma once

#include <optional>
#include <vector>

#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

// The mesh must outlive it.
class NearNodes {
 public:
  explicit NearNodes(const TetMesh& mesh);

  // The node nearest to a point, if one is not farther away than `distance` (m).
  std::optional<int> within(double distance, const Vec3& point) const;

 private:
  const TetMesh& mesh_;
  std::vector<int> by_x_;  // all nodes by ascending x
};

}  // namespace orthodyn
