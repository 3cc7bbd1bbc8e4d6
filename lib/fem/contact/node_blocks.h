// Velocities, forces and matrices of the four nodes of a distance.
#pragma once

#include <array>

#include "lib/fem/block_pattern.h"
#include "lib/fem/contact/distance.h"
#include "lib/fem/nodal_vector.h"

namespace orthodyn {

using FourNodes = std::array<int, 4>;

inline Vec3 relative_velocity(const Distance& distance, const FourNodes& nodes, const NodalVector& v) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 4; ++k) sum += distance.share[k] * v.col(nodes[static_cast<std::size_t>(k)]);
  return sum;
}

// Adds a force on the first point, and its opposite on the second one.
inline void add_pair_of_forces(const Distance& distance, const FourNodes& nodes, const Vec3& force, NodalVector& f) {
  for (int k = 0; k < 4; ++k) f.col(nodes[static_cast<std::size_t>(k)]) += distance.share[k] * force;
}

// block(i, j): the 3 x 3 matrix between two of the four nodes. `place.has_node(k)` is false for nodes without one.
template <class Place, class Block>
void add_blocks(const BlockPattern& pattern, const Place& place, const FourNodes& nodes, Block&& block,
                double* values) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const int a = nodes[static_cast<std::size_t>(i)], b = nodes[static_cast<std::size_t>(j)];
      if (!place.has_node(i) || !place.has_node(j) || (pattern.symmetric() && a < b)) continue;
      pattern.add(a, b, pattern.offset(a, b), Mat3(block(i, j)), values);
    }
}

}  // namespace orthodyn
