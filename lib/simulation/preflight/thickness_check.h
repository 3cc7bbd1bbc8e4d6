// Linear tetrahedra through the thickness of a region: with one to three of them bodies that bend are far too stiff
// (docs/accuracy.md).
#pragma once

#include <string>
#include <vector>

#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

// A region whose nodes are all on its surface is one element thick; one whose nodes are all there or one edge from
// there two or three. One sentence for each such region of a mesh of linear elements; none for quadratic ones.
std::vector<std::string> thin_regions(const TetMesh& mesh);

}  // namespace orthodyn
