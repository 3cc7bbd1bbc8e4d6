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

inline void set_order(TetMesh& mesh, std::optional<int> order) {
  if (!order || *order == mesh.order()) return;
  if (*order == 2) make_quadratic(mesh);
  else make_linear(mesh);
}

}  // namespace orthodyn
