// The sparsity pattern of a mesh, and where the 3x3 block of two nodes lies in it. Const functions may run at the same
// time, add() on different values.
#pragma once

#include <utility>
#include <vector>

#include "lib/core/cells.h"
#include "lib/core/pattern.h"
#include "lib/fem/dof_map.h"

namespace orthodyn {

using NodePairs = std::vector<std::pair<int, int>>;

class BlockPattern {
 public:
  // Couples the nodes of each cell, and the further pairs. `dofs` must outlive the pattern. Throws ConfigError if the
  // matrix had more than 2^31 entries.
  BlockPattern(const Cells& cells, const DofMap& dofs, bool symmetric, const NodePairs& further = {});

  const Pattern& pattern() const { return pattern_; }
  // Makes it one of those of several ranks.
  void set_share(PatternShare share) { pattern_.share = std::make_shared<const PatternShare>(std::move(share)); }
  bool symmetric() const { return pattern_.symmetric; }

  // Where node a's rows begin in the first column of node b, relative to that column's start.
  // Precondition: the nodes are coupled; for a symmetric pattern a >= b. Meaningless if either has no unknowns.
  int offset(int a, int b) const;

  // values[block (a, b)] += block. `offset` is offset(a, b).
  void add(int a, int b, int offset, const Mat3& block, double* values) const;

  // In a symmetric pattern: whether all coordinates of a node are unknowns.
  bool is_free(int node) const { return columns_[static_cast<std::size_t>(node)].length > 0; }
  // add() below the block of a free node b in a symmetric pattern, the other node being free, too. Without a branch;
  // entry (r, c) of the block is at block[r rows + c columns].
  void add_free(int b, int offset, const double* block, int rows, int columns, double* values) const;
  // The same for the diagonal block of a free node.
  void add_free_diagonal(int node, const double* block, int rows, int columns, double* values) const;

 private:
  // Of a free node in a symmetric pattern: its first column, and how many entries that has; else 0.
  struct Columns {
    int start = 0, length = 0;
  };
  const Columns& columns_of(int node) const { return columns_[static_cast<std::size_t>(node)]; }
  void find_columns();

  const DofMap& dofs_;
  Pattern pattern_;
  std::vector<Columns> columns_;
};

// The second and third column of a node have one and two entries less: those above the diagonal.
inline void BlockPattern::add_free(int b, int offset, const double* block, int rows, int columns,
                                   double* values) const {
  const auto [start, length] = columns_of(b);
  double* const first = values + start + offset;
  double* const at[3] = {first, first + length - 1, first + 2 * length - 3};
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) at[c][r] += block[r * rows + c * columns];
}

inline void BlockPattern::add_free_diagonal(int node, const double* block, int rows, int columns,
                                            double* values) const {
  const auto [start, length] = columns_of(node);
  double* const first = values + start;
  double* const at[3] = {first, first + length - 1, first + 2 * length - 3};
  for (int c = 0; c < 3; ++c)
    for (int r = c; r < 3; ++r) at[c][r] += block[r * rows + c * columns];
}

}  // namespace orthodyn
