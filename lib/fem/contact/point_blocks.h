// Velocities, forces and matrices of the four points of a distance.
#pragma once

#include <array>

#include "lib/fem/block_pattern.h"
#include "lib/fem/contact/distance.h"
#include "lib/fem/contact/face_middles.h"
#include "lib/fem/nodal_vector.h"

namespace orthodyn {

using FourPoints = std::array<int, 4>;

inline Vec3 relative_velocity(const Distance& distance, const FourPoints& points, const NodalVector& v) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 4; ++k) sum += distance.share[k] * v.col(points[static_cast<std::size_t>(k)]);
  return sum;
}

// Adds the force on a point to its nodes.
inline void add_force_at(const FaceMiddles& middles, int point, const Vec3& force, NodalVector& f) {
  middles.for_each_node(point, [&](int node, double weight) { f.col(node) += weight * force; });
}

// Adds a force on the first of the nearest points, and its opposite on the second one.
inline void add_pair_of_forces(const FaceMiddles& middles, const Distance& distance, const FourPoints& points,
                               const Vec3& force, NodalVector& f) {
  for (int k = 0; k < 4; ++k) add_force_at(middles, points[static_cast<std::size_t>(k)], distance.share[k] * force, f);
}

// Adds the matrix between two points to their nodes.
inline void add_block_at(const BlockPattern& pattern, const FaceMiddles& middles, int first, int second,
                         const Mat3& block, double* values) {
  middles.for_each_node(first, [&](int a, double of_a) {
    middles.for_each_node(second, [&](int b, double of_b) {
      if (pattern.symmetric() && a < b) return;
      pattern.add(a, b, pattern.offset(a, b), of_a * of_b * block, values);
    });
  });
}

// block(i, j): the 3 x 3 matrix between two of the four points. `place.has_point(k)` is false for points without one.
template <class Place, class Block>
void add_blocks(const BlockPattern& pattern, const FaceMiddles& middles, const Place& place, const FourPoints& points,
                Block&& block, double* values) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (place.has_point(i) && place.has_point(j))
        add_block_at(pattern, middles, points[static_cast<std::size_t>(i)], points[static_cast<std::size_t>(j)],
                     Mat3(block(i, j)), values);
}

}  // namespace orthodyn
