// Parts of a mesh by Scotch.
#pragma once

#include <vector>

#include "lib/core/ranks.h"

namespace orthodyn::petsc {

// Of each cell the part it is in, as Ranks::partition() has it, by this process alone. Precondition: a Session lives.
std::vector<int> partition_cells(const CellGraph& graph, int parts);

}  // namespace orthodyn::petsc
