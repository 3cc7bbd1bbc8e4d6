// The processes that compute one model together, each of them a part of it: MPI's ranks, as far as a model needs them.
//
// All but rank() and size() are collective: every rank calls them, in the same order. What they give is the same on all
// ranks, to the bit.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace orthodyn {

// Nodes that several ranks have: one of them owns each, the others have copies of it.
class NodeExchange {
 public:
  virtual ~NodeExchange() = default;
  // Three numbers for each node of this rank, those that it owns first.
  virtual void copy_from_owners(double* values) const = 0;
  // Adds the copies' numbers to the owner's; the copies' become zero.
  virtual void add_to_owners(double* values) const = 0;
};

// A node of another rank: which one, and its place among those that this one owns.
using RemoteNode = std::pair<int, int>;

// Which cells are neighbours of which, as rows of a sparse matrix.
struct CellGraph {
  std::vector<int> start;       // of each cell, and the end
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

  // The sum over the ranks before this one.
  virtual long sum_before(long value) const = 0;

  // What the first rank has.
  virtual void broadcast(std::span<double> values) const = 0;
  bool as_first_says(bool here) const {
    double value = here ? 1 : 0;
    broadcast(std::span(&value, 1));
    return value != 0;
  }

  // On the first rank the values of all, one rank after the other; nothing on others. Fewer than 2^31.
  virtual std::vector<double> gather(std::span<const double> values) const = 0;
  // Divides the first rank's values among all, in their order: each gets as many as it has room for.
  virtual void scatter(std::span<const double> of_all, std::span<double> here) const = 0;

  // Of each cell the part it is in, of `size()` parts of about as many cells each with few neighbours in others; some
  // are empty where cells are few. The same graph gives the same parts.
  virtual std::vector<int> partition(const CellGraph& graph) const = 0;

  // `copies`: where the owner of each copy has it, in the order of the copies here.
  virtual std::unique_ptr<NodeExchange> exchange(int owned, const std::vector<RemoteNode>& copies) const = 0;

  // Waits for the others to come here as well, for so many seconds. False if they do not: they then are somewhere else,
  // and nothing is left but abort().
  virtual bool meet(double seconds) const = 0;
  // Ends all ranks.
  [[noreturn]] virtual void abort(int exit_code) const = 0;
};

}  // namespace orthodyn
