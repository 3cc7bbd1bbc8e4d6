// The MPI ranks of this run.
#pragma once

#include "lib/core/ranks.h"

namespace orthodyn {

// Returns null, and does not start MPI, for a single process. Throws ConfigError for several processes in a build
// without MPI.
const Ranks* mpi_world();

// As Ranks::partition(), but for any number of parts and not collective. Throws ConfigError in a build without MPI.
std::vector<int> parts_of_cells(const CellGraph& graph, int parts);

// is_one_of_several_ranks(): true if the launcher started several processes. is_a_later_rank(): true if this process is
// not the first of them. Neither function starts MPI.
bool is_one_of_several_ranks();
bool is_a_later_rank();

}  // namespace orthodyn
