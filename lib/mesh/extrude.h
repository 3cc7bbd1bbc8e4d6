// Extrudes a plane mesh along z into layers: triangles into wedges, each split into three tets, quadrilaterals into
// hexahedra.
#pragma once

#include <array>
#include <vector>

#include "lib/mesh/mesh.h"

namespace orthodyn {

using Triangle = std::array<int, 3>;       // node indices
using Quadrilateral = std::array<int, 4>;  // node indices

// A mesh of triangles or of quadrilaterals, counter-clockwise.
struct PlaneMesh {
  std::vector<std::array<double, 2>> nodes;  // m
  std::vector<Triangle> triangles = {};
  std::vector<Quadrilateral> quadrilaterals = {};
};

// Nodes are numbered layer by layer. The diagonal of a side face starts at the node with the lower number in the plane,
// so that neighbours match. The split is mirrored from layer to layer, so that no sense of rotation is preferred.
// `length` in m. The mesh has one region "body" and no surfaces.
Mesh extrude(const PlaneMesh& plane, double length, int layers);

}  // namespace orthodyn
