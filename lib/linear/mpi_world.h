// The ranks that mpirun has started.
#pragma once

#include "lib/core/ranks.h"

namespace orthodyn {

// Null where this process is alone: then MPI is not started either. Throws ConfigError where it is one of several, and
// this build has no MPI.
const Ranks* mpi_world();

// Of each cell the part it is in, as Ranks::partition() has it, for any number of parts, by this process alone. Throws
// ConfigError where this build has no MPI.
std::vector<int> parts_of_cells(const CellGraph& graph, int parts);

// Whether it is one of several, and whether another one is the first of them, as the launcher tells it: without
// starting MPI.
bool is_one_of_several_ranks();
bool is_a_later_rank();

}  // namespace orthodyn
