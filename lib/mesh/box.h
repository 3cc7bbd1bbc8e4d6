// A box: a grid of hexahedra, or of cells that are each split into two wedges, or into five or six tets.
#pragma once

#include <array>
#include <vector>

#include "lib/core/types.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

struct BoxMesh {
  // five: four corner tets around a central one, mirrored from cell to cell so that diagonals match. The mesh is
  // symmetric about the mid planes of axes with an even cell count.
  // six: Kuhn (1960), all cells alike around the diagonal (0,0,0)-(1,1,1). The mesh has no mirror symmetry.
  enum class Split { five, six };
  // wedges: two per cell, with triangles in planes of constant z. hexahedra: one per cell.
  enum class Elements { tetrahedra, wedges, hexahedra };

  Vec3 size = Vec3::Ones();              // m
  std::array<int, 3> cells = {1, 1, 1};  // along x, y, z
  Vec3 origin = Vec3::Zero();            // the corner with the lowest coordinates, m
  std::vector<double> layers = {};       // heights of the cells along z, in proportion; empty: all equal
  Elements elements = Elements::tetrahedra;
  Split split = Split::five;  // of tetrahedra
};

// One region "body"; surfaces "x0", "x1", "y0", "y1", "z0", "z1" at the lowest and highest x, y, z, oriented outward.
// Nodes and cells are numbered along x first, then y, then z. Throws ConfigError (without place) if a cell count is
// below 1, a size is not positive, a number is not finite, the heights of layers are not as many as cells along z or
// not positive, or the mesh has more nodes or elements than an int can count.
Mesh make_box(const BoxMesh& box);

}  // namespace orthodyn
