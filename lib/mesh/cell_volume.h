// The volume of a solid element by its own shape functions. The tetrahedra that replace it have the same volume only if
// no face is curved across its diagonal.
//
// By the divergence theorem V = 1/3 int x . n dA over the faces, which are triangles of 3 or 6 nodes and quadrilaterals
// of 4, 8 (serendipity) or 9 nodes. This covers hexahedra of 8, 20 and 27 nodes, wedges of 6, 15 and 18 nodes and
// pyramids of 5, 13 and 14 nodes. 3 x 3 Gauss points integrate exactly.
#pragma once

#include <functional>

#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// Volume in m^3, negative for an inverted element. `position` returns the coordinates (m) of a node tag.
double volume_of(const FileCell& cell, const std::function<const Vec3&(std::int64_t node)>& position);

}  // namespace orthodyn
