// Round bodies: a full cylinder and a tube, of graded rings of cells around an axis.
#pragma once

#include "lib/core/types.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

struct RoundCells {
  int around = 16;     // of the circumference
  int through = 2;     // rings of cells: through the wall of a tube, outside of the core of a cylinder
  int along = 8;       // layers along the axis
  double grading = 1;  // thickness of the outermost ring over that of the innermost
};

// The cross section is a rounded square of around/4 by around/4 cells, inside of rings that become
// round towards the outside: no cells meet in a point at the axis.
struct CylinderMesh {
  double radius = 1, length = 1;  // m
  Vec3 origin = Vec3::Zero();     // centre of end0, m
  Vec3 axis{0, 0, 1};             // from end0 to end1, of any length
  RoundCells cells;
  int order = 1;  // 2: quadratic, with curved edges
};

struct TubeMesh {
  double inner_radius = 0.5, radius = 1, length = 1;  // m
  Vec3 origin = Vec3::Zero();                         // centre of end0, m
  Vec3 axis{0, 0, 1};                                 // from end0 to end1, of any length
  RoundCells cells;
  int order = 1;  // 2: quadratic, with curved edges
};

// One region "body"; surfaces "end0", "end1", "outer" and, of the tube, "inner", oriented outward.
// The circles are regular polygons of `around` corners on the circle; at order 2 the nodes on edges lie on the true
// surfaces, and between them where the rings would bend. Throw ConfigError (without a
// file) for sizes that are not positive and finite, counts below 1 (around: below 3, and for the
// cylinder not a multiple of 4), a grading outside of [0.01, 100], a zero axis, and more nodes or tets
// than an int can count.
TetMesh make_cylinder(const CylinderMesh& cylinder);
TetMesh make_tube(const TubeMesh& tube);

}  // namespace orthodyn
