#include "lib/linear/mpi_world.h"

#include <cstdlib>
#include <memory>

#include "lib/linear/petsc_library.h"

namespace orthodyn {

// Reads the environment variables of Open MPI, MPICH and Slurm with PMI or PMIx.
bool is_one_of_several_ranks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"})
    if (const char* size = std::getenv(name)) return std::atoi(size) > 1;
  if (const char* size = std::getenv("SLURM_STEP_NUM_TASKS"); size && std::getenv("PMIX_RANK"))
    return std::atoi(size) > 1;
  return false;
}

bool is_a_later_rank() {
  if (!is_one_of_several_ranks()) return false;
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK", "SLURM_PROCID"})
    if (const char* rank = std::getenv(name)) return std::atoi(rank) > 0;
  return false;
}

const Ranks* mpi_world() {
  if (!is_one_of_several_ranks()) return nullptr;
  return reinterpret_cast<WorldRanks*>(petsc_function("orthodyn_mpi_world"))();
}

std::vector<int> parts_of_cells(const CellGraph& graph, int parts) {
  static auto* const partition = reinterpret_cast<PartitionCells*>(petsc_function("orthodyn_partition_cells"));
  const std::unique_ptr<std::vector<int>> of_cells(partition(graph, parts));
  return std::move(*of_cells);
}

}  // namespace orthodyn
