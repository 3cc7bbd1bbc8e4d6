// A plane mesh of triangles drawn out along z into layers of prisms, each cut into three tets.
#pragma once

#include <array>
#include <vector>

#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

struct PlaneMesh {
  std::vector<std::array<double, 2>> nodes;  // m
  std::vector<Triangle> triangles;           // counter-clockwise
};

// Nodes are numbered layer by layer. Prisms are cut by the order of their nodes in the plane (the
// diagonal of a side face starts at its lower node), so that neighbours match; from layer to layer the
// cut is mirrored, so that no sense of rotation is preferred. One region "body", no surfaces.
TetMesh extrude(const PlaneMesh& plane, double length, int layers);

}  // namespace orthodyn
