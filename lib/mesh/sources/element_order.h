// The key `order` of mesh sources: linear or quadratic tetrahedra.
#pragma once

#include <optional>

#include "lib/config/spec.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

inline constexpr const char* kOrderSentence =
    "1: linear tetrahedra, stiff in bending and torsion. 2: quadratic ones, with a node on each edge.";
inline constexpr const char* kFileOrderSentence =
    "1: linear tetrahedra, stiff in bending and torsion. 2: quadratic ones, with a node on each edge. Default: as the "
    "file has.";
inline const Rule kOrderRule{.range = {1, 2}};

inline void set_order(TetMesh& mesh, std::optional<int> order) {
  if (!order || *order == mesh.order()) return;
  if (*order == 2) make_quadratic(mesh);
  else make_linear(mesh);
}

}  // namespace orthodyn
