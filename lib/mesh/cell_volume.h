// The volume of a solid element of a file by its own shape functions, which the tetrahedra that it is split into have
// exactly only if its faces are such that a diagonal can cut them.
//
// By the divergence theorem, V = 1/3 int x . n dA over its faces: bilinear quadrilaterals, those of 8 nodes
// (serendipity) and of 9, triangles of 3 and 6 nodes, which are what hexahedra of 8, 20 and 27 nodes, wedges of 6, 15
// and 18 and pyramids of 5, 13 and 14 have on their surface. Three Gauss points each way are exact.
#pragma once

#include <functional>

#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// m^3; negative of an element that is inverted.
double volume_of(const FileCell& cell, const std::function<const Vec3&(std::int64_t node)>& position);

}  // namespace orthodyn
