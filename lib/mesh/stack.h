// Columns of hexahedra or wedges across the thickness of a layered region.
#pragma once

#include <functional>
#include <vector>

#include "lib/mesh/mesh.h"

namespace orthodyn {

// An axis of a cell is along a direction if the cosine of their angle has at least this magnitude.
inline constexpr double kAlongStack = 0.7;

// A level: the i-th cell from the bottom of each column with n cells. Heights are fractions of the column height
// (0 at its bottom, 1 at its top), averaged over the columns.
struct StackLevel {
  std::vector<int> cells;  // ascending
  double bottom, top;
};

struct Stack {
  std::vector<StackLevel> levels;
  double lowest, highest;  // smallest and largest height of a column, m
};

// Arranges the cells of a region in columns along `direction` (a unit vector for each cell). Renumbers the nodes of
// each cell so that its third natural coordinate grows along its direction. Throws ConfigError if a cell is not a
// quadratic hexahedron or wedge, if none of its axes is along its direction, if cells form closed rings, or if
// the tops of a level's cells differ by more than 2 % of the column height.
Stack make_stack(Mesh& mesh, int region, const std::function<Vec3(int cell)>& direction);

}  // namespace orthodyn
