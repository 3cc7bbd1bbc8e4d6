#include "lib/linear/world.h"

#include <cstdlib>
#include <string>

#include "lib/core/errors.h"
#include "lib/linear/petsc_library.h"

namespace orthodyn {

// As the launchers of Open MPI, MPICH and Slurm with PMI tell it.
bool is_one_of_several_ranks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"})
    if (const char* size = std::getenv(name)) return std::atoi(size) > 1;
  return false;
}

const Ranks* world_ranks() {
  if (!is_one_of_several_ranks()) return nullptr;
  return reinterpret_cast<WorldRanks*>(petsc_function("orthodyn_world_ranks"))();
}

}  // namespace orthodyn
