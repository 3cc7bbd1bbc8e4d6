// The key `order` of mesh sources: linear or quadratic tetrahedra.
#pragma once

#include <optional>

#include "lib/config/spec.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

inline constexpr const char* kOrderSentence =
    "2: quadratic tetrahedra, with a node on each edge. 1: linear ones, stiff in bending and torsion.";
inline constexpr const char* kFileOrderSentence =
    "2: quadratic tetrahedra, with a node on each edge. 1: linear ones, stiff in bending and torsion. Default: as the "
    "file has.";
inline constexpr int kDefaultOrder = 2;  // of meshes that are made; files have their own
inline const Rule kOrderRule{.range = {1, 2}};

// Returns the node sets that are empty then: those of nodes on edges only.
inline std::vector<std::string> set_order(TetMesh& mesh, std::optional<int> order) {
  if (!order || *order == mesh.order()) return {};
  if (*order == 1) return make_linear(mesh);
  make_quadratic(mesh);
  return {};
}

}  // namespace orthodyn
