// A full cylinder and a tube of tetrahedra or hexahedra, in graded rings around an axis.
#pragma once

#include "lib/core/types.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

struct RoundCells {
  int around = 16;     // cells on the circumference
  int through = 2;     // rings: through the wall of a tube, or around the core of a cylinder
  int along = 8;       // layers along the axis
  double grading = 1;  // thickness of the outermost ring divided by that of the innermost
};

struct RoundMesh {
  enum class Elements { tetrahedra, hexahedra };

  double radius = 1, length = 1;  // m
  Vec3 origin = Vec3::Zero();     // centre of end0, m
  Vec3 axis{0, 0, 1};             // from end0 to end1, of any length
  RoundCells cells = {};
  Elements elements = Elements::tetrahedra;
  int order = 1;  // 2: quadratic, with curved edges
};

// The core of the cross section is a rounded square of around/4 by around/4 cells; the rings around it become circular
// towards the outside. No cells meet in a point at the axis.
using CylinderMesh = RoundMesh;

struct TubeMesh : RoundMesh {
  double inner_radius = 0.5;  // m
};

// One region "body"; surfaces "end0", "end1", "outer" and, for the tube, "inner", oriented outward. Corners of elements
// on the surface form a regular polygon on the circle. At order 2, mid-edge nodes lie on the true surfaces and, inside,
// follow the rings. Throw ConfigError (without place) for sizes that are not positive and finite, counts below 1,
// `around` below 3 or, for the cylinder, not a multiple of 4, a grading outside [0.01, 100], a zero axis, and more
// nodes or elements than an int can count.
Mesh make_cylinder(const CylinderMesh& cylinder);
Mesh make_tube(const TubeMesh& tube);

}  // namespace orthodyn
