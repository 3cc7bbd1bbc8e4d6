// Ranks (lib/core/ranks.h) by MPI, with PETSc's star forests for copies of nodes.
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
#include "lib/linear/petsc_library.h"
#include "lib/petsc/handle.h"
#include "lib/petsc/partition.h"
#include "lib/petsc/session.h"

namespace orthodyn::petsc {
namespace {

// How many values each rank has, known to the first.
struct Counts {
  explicit Counts(int here) {
    int rank = 0, size = 1;
    check_mpi(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
    check_mpi(MPI_Comm_size(PETSC_COMM_WORLD, &size));
    if (rank == 0) of_rank.resize(static_cast<std::size_t>(size));
    check_mpi(MPI_Gather(&here, 1, MPI_INT, of_rank.data(), 1, MPI_INT, 0, PETSC_COMM_WORLD));
    std::int64_t all = std::accumulate(of_rank.begin(), of_rank.end(), std::int64_t{0});
    check_mpi(MPI_Bcast(&all, 1, MPI_INT64_T, 0, PETSC_COMM_WORLD));
    if (all > std::numeric_limits<int>::max())
      throw RunError("2^31 numbers and more do not go to one rank; set linear_solver: petsc", Reason::out_of_memory);
    starts.resize(of_rank.size());
    std::exclusive_scan(of_rank.begin(), of_rank.end(), starts.begin(), 0);
    if (rank == 0) sum = static_cast<std::size_t>(all);
  }

  std::vector<int> of_rank, starts;
  std::size_t sum = 0;
};

int count_of(std::span<const double> values) {
  if (values.size() > std::numeric_limits<int>::max())
    throw RunError("MPI sends less than 2^31 numbers at a time; use a coarser mesh");
  return static_cast<int>(values.size());
}

class StarForest : public NodeExchange {
 public:
  StarForest(int owned, const std::vector<RemoteNode>& copies) : owned_(owned), copies_(copies.size()) {
    const Session session;
    OwnedForest forest;  // which ends while the session lives, should it not be made
    std::vector<PetscSFNode> roots;
    for (const auto& [rank, place] : copies) roots.push_back({rank, place});
    std::vector<PetscInt> leaves;
    for (std::size_t i = 0; i < copies.size(); ++i) leaves.push_back(owned + static_cast<PetscInt>(i));
    check(PetscSFCreate(PETSC_COMM_WORLD, forest.receive()));
    check(PetscSFSetGraph(forest, owned, static_cast<PetscInt>(leaves.size()), leaves.data(), PETSC_COPY_VALUES,
                          roots.data(), PETSC_COPY_VALUES));
    check(PetscSFSetUp(forest));
    check_mpi(MPI_Type_contiguous(3, MPI_DOUBLE, &three_));
    check_mpi(MPI_Type_commit(&three_));
    forest_ = std::move(forest);
  }
  ~StarForest() override {
    const Session session;
    MPI_Type_free(&three_);
    forest_.reset();
  }
  StarForest(const StarForest&) = delete;
  StarForest& operator=(const StarForest&) = delete;

  void copy_from_owners(double* values) const override {
    const Session session;
    check(PetscSFBcastBegin(forest_, three_, values, values, MPI_REPLACE));
    check(PetscSFBcastEnd(forest_, three_, values, values, MPI_REPLACE));
  }

  void add_to_owners(double* values) const override {
    const Session session;
    check(PetscSFReduceBegin(forest_, three_, values, values, MPI_SUM));
    check(PetscSFReduceEnd(forest_, three_, values, values, MPI_SUM));
    std::fill_n(values + 3 * owned_, 3 * copies_, 0.0);
  }

 private:
  OwnedForest forest_;
  MPI_Datatype three_ = MPI_DATATYPE_NULL;
  int owned_ = 0;
  std::size_t copies_ = 0;
};

class MpiRanks : public Ranks {
 public:
  MpiRanks() {
    const Session session;
    check_mpi(MPI_Comm_rank(PETSC_COMM_WORLD, &rank_));
    check_mpi(MPI_Comm_size(PETSC_COMM_WORLD, &size_));
    check_mpi(MPI_Comm_dup(PETSC_COMM_WORLD, &meeting_));
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
    const Counts counts(count_of(values));
    std::vector<double> all(counts.sum);
    check_mpi(MPI_Gatherv(values.data(), count_of(values), MPI_DOUBLE, all.data(), counts.of_rank.data(),
                          counts.starts.data(), MPI_DOUBLE, 0, PETSC_COMM_WORLD));
    return all;
  }

  void scatter(std::span<const double> of_all, std::span<double> here) const override {
    const Session session;
    const Counts counts(count_of(here));
    check_mpi(MPI_Scatterv(of_all.data(), counts.of_rank.data(), counts.starts.data(), MPI_DOUBLE, here.data(),
                           count_of(here), MPI_DOUBLE, 0, PETSC_COMM_WORLD));
  }

  // By the first rank alone, so that the parts do not depend on how it is done in parallel.
  std::vector<int> partition(const CellGraph& graph) const override {
    const Session session;
    std::vector<int> part(graph.start.size() - 1, 0);
    std::string trouble;
    if (rank_ == 0) {
      try {
        part = partition_cells(graph, size_);
      } catch (const std::exception& e) {
        trouble = e.what();
      }
    }
    int failed = trouble.empty() ? 0 : 1;
    check_mpi(MPI_Bcast(&failed, 1, MPI_INT, 0, PETSC_COMM_WORLD));
    if (failed != 0) throw RunError(trouble.empty() ? "the mesh cannot be partitioned" : trouble);
    check_mpi(MPI_Bcast(part.data(), static_cast<int>(part.size()), MPI_INT, 0, PETSC_COMM_WORLD));
    return part;
  }

  std::unique_ptr<NodeExchange> exchange(int owned, const std::vector<RemoteNode>& copies) const override {
    return std::make_unique<StarForest>(owned, copies);
  }

  bool meet(double seconds) const override {
    if (is_alone_) return false;
    const Session session;
    MPI_Request request = MPI_REQUEST_NULL;
    check_mpi(MPI_Ibarrier(meeting_, &request));
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
      int all_are_here = 0;
      check_mpi(MPI_Test(&request, &all_are_here, MPI_STATUS_IGNORE));
      if (all_are_here != 0) return true;
      if (std::chrono::steady_clock::now() > until) return !(is_alone_ = true);
      usleep(1000);
    }
  }

  void abort(int exit_code) const override {
    std::fflush(nullptr);  // MPI may end this process as it is
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
  }

 private:
  void reduce(std::span<double> values, MPI_Op operation) const {
    const Session session;
    check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), count_of(values), MPI_DOUBLE, operation, PETSC_COMM_WORLD));
  }

  int rank_ = 0, size_ = 1;
  MPI_Comm meeting_ = MPI_COMM_NULL;
  mutable bool is_alone_ = false;  // the others did not come
};

}  // namespace
}  // namespace orthodyn::petsc

extern "C" [[gnu::visibility("default")]] const orthodyn::Ranks* orthodyn_world_ranks() {
  static const orthodyn::petsc::MpiRanks world;  // for the process's life
  return world.size() > 1 ? &world : nullptr;
}
