// Ranks (lib/core/ranks.h) by MPI, with PETSc's star forests and, through PETSc, partitions by Scotch (Pellegrini).
#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/ranks.h"
#include "lib/petsc/handle.h"
#include "lib/petsc/session.h"

namespace orthodyn::petsc {
namespace {

// The number of values of each rank, known on the first rank.
struct RankCounts {
  explicit RankCounts(int here) {
    int rank = 0, size = 1;
    check_mpi(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
    check_mpi(MPI_Comm_size(PETSC_COMM_WORLD, &size));
    if (rank == 0) of_rank.resize(static_cast<std::size_t>(size));
    check_mpi(MPI_Gather(&here, 1, MPI_INT, of_rank.data(), 1, MPI_INT, 0, PETSC_COMM_WORLD));
    std::int64_t all = std::accumulate(of_rank.begin(), of_rank.end(), std::int64_t{0});
    check_mpi(MPI_Bcast(&all, 1, MPI_INT64_T, 0, PETSC_COMM_WORLD));
    if (all > std::numeric_limits<int>::max())
      throw RunError("one rank cannot receive 2^31 or more numbers; set linear_solver: petsc", Reason::out_of_memory);
    starts.resize(of_rank.size());
    std::exclusive_scan(of_rank.begin(), of_rank.end(), starts.begin(), 0);
    if (rank == 0) sum = static_cast<std::size_t>(all);
  }

  std::vector<int> of_rank, starts;
  std::size_t sum = 0;
};

int count_of(std::span<const double> values) {
  if (values.size() > std::numeric_limits<int>::max())
    throw RunError("MPI cannot send 2^31 or more numbers at a time; use a coarser mesh");
  return static_cast<int>(values.size());
}

// Without this, partitions would not be repeatable: Scotch's random numbers depend on earlier calls, and results of its
// threads (version 7) on timing. PETSc does not expose SCOTCH_randomReset, but the library is loaded.
void make_repeatable() {
  setenv("SCOTCH_PTHREAD_NUMBER", "1", 1);
  if (void* function = dlsym(RTLD_DEFAULT, "SCOTCH_randomReset")) reinterpret_cast<void (*)()>(function)();
}

// As Ranks::partition(), by this process alone. Precondition: a Session exists.
std::vector<int> partition_cells(const CellGraph& graph, int parts) {
  const auto cells = static_cast<PetscInt>(graph.start.size() - 1);
  std::vector<int> part(static_cast<std::size_t>(cells), 0);
  if (cells <= parts) {  // too few for Scotch
    for (PetscInt cell = 0; cell < cells; ++cell) part[static_cast<std::size_t>(cell)] = cell;
    return part;
  }
  make_repeatable();
  PetscInt *start = nullptr, *neighbours = nullptr;  // freed by PETSc
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

class StarForest : public NodeExchange {
 public:
  StarForest(int owned, const std::vector<RemoteNode>& copies) : owned_(owned), copies_(copies.size()) {
    const Session session;
    OwnedForest forest;  // local, so that it is destroyed during the session if this constructor throws
    std::vector<PetscSFNode> roots;
    for (const auto& [rank, place] : copies) roots.push_back({rank, place});
    std::vector<PetscInt> leaves;
    for (std::size_t i = 0; i < copies.size(); ++i) leaves.push_back(owned + static_cast<PetscInt>(i));
    check(PetscSFCreate(PETSC_COMM_WORLD, forest.receive()));
    check(PetscSFSetGraph(forest, owned, static_cast<PetscInt>(leaves.size()), leaves.data(), PETSC_COPY_VALUES,
                          roots.data(), PETSC_COPY_VALUES));
    check(PetscSFSetUp(forest));
    check_mpi(MPI_Type_contiguous(3, MPI_DOUBLE, &node_type_));
    check_mpi(MPI_Type_commit(&node_type_));
    forest_ = std::move(forest);
  }
  ~StarForest() override {
    const Session session;
    MPI_Type_free(&node_type_);
    forest_.reset();
  }
  StarForest(const StarForest&) = delete;
  StarForest& operator=(const StarForest&) = delete;

  void copy_from_owners(double* values) const override {
    const Session session;
    check(PetscSFBcastBegin(forest_, node_type_, values, values, MPI_REPLACE));
    check(PetscSFBcastEnd(forest_, node_type_, values, values, MPI_REPLACE));
  }

  void add_to_owners(double* values) const override {
    const Session session;
    check(PetscSFReduceBegin(forest_, node_type_, values, values, MPI_SUM));
    check(PetscSFReduceEnd(forest_, node_type_, values, values, MPI_SUM));
    std::fill_n(values + 3 * owned_, 3 * copies_, 0.0);
  }

 private:
  OwnedForest forest_;
  MPI_Datatype node_type_ = MPI_DATATYPE_NULL;
  int owned_ = 0;
  std::size_t copies_ = 0;
};

class MpiRanks : public Ranks {
 public:
  MpiRanks() {
    const Session session;
    check_mpi(MPI_Comm_rank(PETSC_COMM_WORLD, &rank_));
    check_mpi(MPI_Comm_size(PETSC_COMM_WORLD, &size_));
    check_mpi(MPI_Comm_dup(PETSC_COMM_WORLD, &barrier_));
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void sum(std::span<double> values) const override { reduce(values, MPI_SUM); }
  void max(std::span<double> values) const override { reduce(values, MPI_MAX); }

  long sum_before(long value) const override {
    const Session session;
    long sum = 0;
    check_mpi(MPI_Exscan(&value, &sum, 1, MPI_LONG, MPI_SUM, PETSC_COMM_WORLD));
    return rank_ > 0 ? sum : 0;
  }

  void broadcast(std::span<double> values) const override {
    const Session session;
    check_mpi(MPI_Bcast(values.data(), count_of(values), MPI_DOUBLE, 0, PETSC_COMM_WORLD));
  }

  std::vector<double> gather(std::span<const double> values) const override {
    const Session session;
    const RankCounts counts(count_of(values));
    std::vector<double> all(counts.sum);
    check_mpi(MPI_Gatherv(values.data(), count_of(values), MPI_DOUBLE, all.data(), counts.of_rank.data(),
                          counts.starts.data(), MPI_DOUBLE, 0, PETSC_COMM_WORLD));
    return all;
  }

  void scatter(std::span<const double> of_all, std::span<double> here) const override {
    const Session session;
    const RankCounts counts(count_of(here));
    check_mpi(MPI_Scatterv(of_all.data(), counts.of_rank.data(), counts.starts.data(), MPI_DOUBLE, here.data(),
                           count_of(here), MPI_DOUBLE, 0, PETSC_COMM_WORLD));
  }

  // Partitions on the first rank alone, so that the parts do not depend on the parallel algorithm.
  std::vector<int> partition(const CellGraph& graph) const override {
    const Session session;
    std::vector<int> part(graph.start.size() - 1, 0);
    std::string failure;
    if (rank_ == 0) {
      try {
        part = partition_cells(graph, size_);
      } catch (const std::exception& e) {
        failure = e.what();
      }
    }
    int failed = failure.empty() ? 0 : 1;
    check_mpi(MPI_Bcast(&failed, 1, MPI_INT, 0, PETSC_COMM_WORLD));
    if (failed != 0) throw RunError(failure.empty() ? "the mesh cannot be partitioned" : failure);
    check_mpi(MPI_Bcast(part.data(), static_cast<int>(part.size()), MPI_INT, 0, PETSC_COMM_WORLD));
    return part;
  }

  std::unique_ptr<NodeExchange> exchange(int owned, const std::vector<RemoteNode>& copies) const override {
    return std::make_unique<StarForest>(owned, copies);
  }

  bool barrier_within(double seconds) const override {
    if (timed_out_) return false;
    const Session session;
    MPI_Request request = MPI_REQUEST_NULL;
    check_mpi(MPI_Ibarrier(barrier_, &request));
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
      int all_are_here = 0;
      check_mpi(MPI_Test(&request, &all_are_here, MPI_STATUS_IGNORE));
      if (all_are_here != 0) return true;
      if (std::chrono::steady_clock::now() > until) return !(timed_out_ = true);
      usleep(1000);
    }
  }

  void abort(int exit_code) const override {
    std::fflush(nullptr);  // MPI_Abort may not flush
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
  }

 private:
  void reduce(std::span<double> values, MPI_Op operation) const {
    const Session session;
    check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), count_of(values), MPI_DOUBLE, operation, PETSC_COMM_WORLD));
  }

  int rank_ = 0, size_ = 1;
  MPI_Comm barrier_ = MPI_COMM_NULL;
  mutable bool timed_out_ = false;
};

}  // namespace
}  // namespace orthodyn::petsc

extern "C" [[gnu::visibility("default")]] const orthodyn::Ranks* orthodyn_mpi_world() {
  static const orthodyn::petsc::MpiRanks world;
  return world.size() > 1 ? &world : nullptr;
}

extern "C" [[gnu::visibility("default")]] std::vector<int>* orthodyn_partition_cells(const orthodyn::CellGraph& graph,
                                                                                     int parts) {
  const orthodyn::petsc::Session session;
  return new std::vector<int>(orthodyn::petsc::partition_cells(graph, parts));
}
