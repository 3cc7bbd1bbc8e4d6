// Shared by mesh sources: the key `order`, and the limit on the number of elements.
#pragma once

#include <optional>

#include "lib/config/spec.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

inline constexpr const char* kOrderSentence =
    "2: quadratic elements, with mid-edge nodes. 1: linear ones, too stiff in bending and torsion.";
inline constexpr const char* kFileOrderSentence =
    "2: quadratic elements, with mid-edge nodes. 1: linear ones, too stiff in bending and torsion. Default: the "
    "order of the file.";
inline constexpr int kDefaultOrder = 2;  // of generated meshes
inline const Rule kOrderRule{.range = {1, 2}};

// Converts the mesh to this order, if one is given. Returns the node sets that become empty: those of mid-edge nodes.
inline std::vector<std::string> set_order(Mesh& mesh, std::optional<int> order) {
  if (!order || *order == mesh.order()) return {};
  if (*order == 1) return make_linear(mesh);
  make_quadratic(mesh);
  return {};
}

// Throws ConfigError at `cells` if the mesh would have more elements than can be numbered or than fit into memory.
void check_mesh_size(double elements, const Config& cells);

}  // namespace orthodyn
