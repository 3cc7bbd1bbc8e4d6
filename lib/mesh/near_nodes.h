// Finds nodes of a mesh by their positions in the rest shape.
#pragma once

#include <optional>
#include <vector>

#include "lib/mesh/mesh.h"

namespace orthodyn {

// The mesh must outlive the object.
class NearNodes {
 public:
  explicit NearNodes(const Mesh& mesh);

  // The node nearest to `point` (m) among those at most `distance` (m) away.
  std::optional<int> within(double distance, const Vec3& point) const;

 private:
  const Mesh& mesh_;
  std::vector<int> by_x_;  // all nodes by ascending x
};

}  // namespace orthodyn
