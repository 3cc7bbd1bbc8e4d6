// Access to liborthodyn_petsc, which contains everything that needs PETSc and MPI.
#pragma once

#include <string>
#include <vector>

namespace orthodyn {

class LinearSolver;
class Ranks;
struct CellGraph;

// Types of the library's functions.
// orthodyn_make_petsc_solver; the caller owns the result.
using MakePetscSolver = LinearSolver*(const std::string& options);
using WorldRanks = const Ranks*();  // orthodyn_mpi_world; null for a single process
// orthodyn_partition_cells; the caller owns the result.
using PartitionCells = std::vector<int>*(const CellGraph& graph, int parts);

// Returns a function of the library, which the first call loads. Throws ConfigError if there is no library, if it
// cannot be loaded or if it lacks this function.
void* petsc_function(const char* name);

}  // namespace orthodyn
