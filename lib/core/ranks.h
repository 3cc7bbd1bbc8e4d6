// The operations on MPI ranks that a model distributed over them needs.
//
// All functions but rank(), size() and abort() are collective: all ranks call them in the same order. Sums, maxima and
// broadcast values have the same bits on all ranks.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace orthodyn {

// Exchange for nodes that several ranks hold: one rank owns each node, the others hold copies.
class NodeExchange {
 public:
  virtual ~NodeExchange() = default;
  // `values`: three numbers for each node of this rank, owned nodes first.
  virtual void copy_from_owners(double* values) const = 0;
  // Adds the values of the copies to those of the owner and sets the copies to zero.
  virtual void add_to_owners(double* values) const = 0;
};

// A node owned by another rank: the owner's rank, and the index among the owner's nodes.
using RemoteNode = std::pair<int, int>;

// The adjacency graph of cells, as the rows of a sparse matrix.
struct CellGraph {
  std::vector<int> start;       // start of each cell's row, and the end of the last
  std::vector<int> neighbours;  // ascending in each row
};

class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  bool is_first() const { return rank() == 0; }

  virtual void sum(std::span<double> values) const = 0;
  virtual void max(std::span<double> values) const = 0;
  double sum(double value) const { return sum(std::span(&value, 1)), value; }
  double max(double value) const { return max(std::span(&value, 1)), value; }
  bool any(bool here) const { return max(here ? 1.0 : 0.0) > 0; }

  // Sum of `value` over the ranks before this one (exclusive scan).
  virtual long sum_before(long value) const = 0;

  // Replaces the values by those of the first rank.
  virtual void broadcast(std::span<double> values) const = 0;
  bool broadcast_flag(bool here) const {
    double value = here ? 1 : 0;
    broadcast(std::span(&value, 1));
    return value != 0;
  }

  // Returns the values of all ranks in the order of the ranks (fewer than 2^31 values) on the first rank, and an empty
  // vector on the others.
  virtual std::vector<double> gather(std::span<const double> values) const = 0;
  // Distributes the first rank's values over the ranks in their order; each rank receives here.size() values.
  virtual void scatter(std::span<const double> of_all, std::span<double> here) const = 0;

  // Divides the cells into size() parts of similar size with few connections between parts, and returns the part of
  // each cell. Parts may be empty if there are few cells. The same graph gives the same parts.
  virtual std::vector<int> partition(const CellGraph& graph) const = 0;

  // `owned`: number of nodes that this rank owns. `copies`: for each copy that it holds, the owner and the index there.
  virtual std::unique_ptr<NodeExchange> exchange(int owned, const std::vector<RemoteNode>& copies) const = 0;

  // A barrier with a time limit. False if some rank did not arrive in time; then only abort() may be called.
  virtual bool barrier_within(double seconds) const = 0;
  // Terminates all ranks.
  [[noreturn]] virtual void abort(int exit_code) const = 0;
};

}  // namespace orthodyn
