// The order in which a file lists the nodes on the edges of quadratic tetrahedra, where its writers differ.
#pragma once

#include <vector>

#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// Puts the middle nodes into the order of kTetEdges: the one in which most elements have them nearest to half way.
// Precondition: all tetrahedra are quadratic.
void sort_middles(const std::vector<FileNode>& nodes, std::vector<FileCell>& tets);

}  // namespace orthodyn
