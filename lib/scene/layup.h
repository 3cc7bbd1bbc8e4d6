// The key `layup` of a region: its plies from bottom to top, stacked along axis 3 of the region's axes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/config/values.h"
#include "lib/fem/element_type.h"
#include "lib/mesh/stack.h"

namespace orthodyn {

struct Ply {
  std::string material;
  double angle = 0;      // rad, from axis 1 of the region to axis 1 of the material, about axis 3
  double thickness = 0;  // m
};

// [material, angle, thickness], such as [beech, 90 deg, 1.5 mm].
template <>
struct Value<Ply> {
  static ValueSchema schema();
  static Ply read(const Config& c, const Rule& r);
  static std::string yaml(const Ply& ply);
};

// The part of a ply that lies in the cells of one level of a stack (lib/mesh/stack.h). It extends from `begin` to `end`
// in the third natural coordinate of the cells, which is in [-1, 1].
struct PlyPart {
  std::size_t ply;    // index in the layup
  std::string name;   // "ply_2", or "ply_2_1", "ply_2_2", ... if it has several parts
  std::size_t level;  // index in Stack::levels
  double begin, end;
  double share() const { return (end - begin) / 2; }  // of the level's height
};

// Divides the plies, scaled to the height of the stack, among its levels. Parts are ordered by level, then from bottom
// to top.
std::vector<PlyPart> divide(const std::vector<Ply>& layup, const Stack& stack);

double total_thickness(const std::vector<Ply>& layup);

}  // namespace orthodyn
