// The way into liborthodyn_petsc, which PETSc, MPI and what needs them are in.
#pragma once

#include <string>
#include <vector>

namespace orthodyn {

class LinearSolver;
class Ranks;
struct CellGraph;

// Of the type of its function `orthodyn_make_petsc_solver`: the caller owns the solver.
using MakePetscSolver = LinearSolver*(const std::string& options);

// Of `orthodyn_world_ranks`: null where this process is alone.
using WorldRanks = const Ranks*();

// Of `orthodyn_partition_cells`: the caller owns what it returns.
using PartitionCells = std::vector<int>*(const CellGraph& graph, int parts);

// A function of the library, which is loaded first. Throws ConfigError if it cannot be, or if this build has none.
void* petsc_function(const char* name);

}  // namespace orthodyn
