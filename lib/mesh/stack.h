// The cells of a layered region: hexahedra and wedges in columns across its thickness.
#pragma once

#include <functional>
#include <vector>

#include "lib/mesh/mesh.h"

namespace orthodyn {

// Smallest cosine between the direction of a stack and the axis of a cell that counts as along it.
inline constexpr double kAlongStack = 0.7;

// One level: the i-th cells from the bottom of all columns that have n cells. Heights are fractions of the column's
// height, from 0 at its bottom to 1 at its top.
struct StackLevel {
  std::vector<int> cells;  // ascending
  double bottom, top;
};

struct Stack {
  std::vector<StackLevel> levels;
  double lowest, highest;  // heights of columns, m
};

// The cells of a region in columns along `direction` (a unit vector for each cell). Renumbers their nodes so that the
// third natural coordinate of each cell grows along its direction. Throws ConfigError if a cell is no quadratic
// hexahedron or wedge, if none of its axes is within 45 degrees of its direction, or if columns divide their height
// differently (by more than 2 %).
Stack make_stack(Mesh& mesh, int region, const std::function<Vec3(int cell)>& direction);

}  // namespace orthodyn
