// Parts of a mesh by Scotch (Pellegrini), by way of PETSc.
#include "lib/petsc/partition.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>

#include "lib/linear/petsc_library.h"
#include "lib/petsc/handle.h"
#include "lib/petsc/session.h"

namespace orthodyn::petsc {

namespace {

// Scotch draws random numbers, which go on from call to call: parts would depend on what was divided before. PETSc does
// not pass its function on, but the library is there. Its threads (version 7) race each other.
void make_repeatable() {
  setenv("SCOTCH_PTHREAD_NUMBER", "1", 1);
  if (void* function = dlsym(RTLD_DEFAULT, "SCOTCH_randomReset")) reinterpret_cast<void (*)()>(function)();
}

}  // namespace

std::vector<int> partition_cells(const CellGraph& graph, int parts) {
  const auto cells = static_cast<PetscInt>(graph.start.size() - 1);
  std::vector<int> part(static_cast<std::size_t>(cells), 0);
  if (cells <= parts) {  // fewer than a partitioner takes
    for (PetscInt cell = 0; cell < cells; ++cell) part[static_cast<std::size_t>(cell)] = cell;
    return part;
  }
  make_repeatable();
  PetscInt *start = nullptr, *neighbours = nullptr;  // PETSc frees them
  check(PetscMalloc1(graph.start.size(), &start));
  check(PetscMalloc1(graph.neighbours.size() + 1, &neighbours));
  std::copy(graph.start.begin(), graph.start.end(), start);
  std::copy(graph.neighbours.begin(), graph.neighbours.end(), neighbours);
  OwnedMatrix adjacency;
  check(MatCreateMPIAdj(PETSC_COMM_SELF, cells, cells, start, neighbours, nullptr, adjacency.receive()));
  OwnedPartitioning partitioning;
  OwnedNumbers numbers;
  check(MatPartitioningCreate(PETSC_COMM_SELF, partitioning.receive()));
  check(MatPartitioningSetAdjacency(partitioning, adjacency));
  check(MatPartitioningSetNParts(partitioning, parts));
  check(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
  check(MatPartitioningApply(partitioning, numbers.receive()));
  const PetscInt* values = nullptr;
  check(ISGetIndices(numbers, &values));
  std::copy_n(values, part.size(), part.begin());
  check(ISRestoreIndices(numbers, &values));
  return part;
}

}  // namespace orthodyn::petsc

extern "C" [[gnu::visibility("default")]] std::vector<int>* orthodyn_partition_cells(const orthodyn::CellGraph& graph,
                                                                                     int parts) {
  const orthodyn::petsc::Session session;
  return new std::vector<int>(orthodyn::petsc::partition_cells(graph, parts));
}
