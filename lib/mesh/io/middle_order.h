// Detects the order of the mid-edge nodes of quadratic tetrahedra, in formats whose writers differ.
#pragma once

#include <vector>

#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// Permutes the mid-edge nodes to the order of kTetEdges, by the permutation that puts them nearest to the edge
// midpoints in most elements. Precondition: all tetrahedra are quadratic.
void sort_middles(const std::vector<FileNode>& nodes, std::vector<FileCell>& tets);

}  // namespace orthodyn
