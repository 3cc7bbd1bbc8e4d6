// Sparsity pattern of a mesh with a 3x3 block for each pair of coupled nodes. Const functions are thread-safe if they
// add to different entries of `values`.
#pragma once

#include <utility>
#include <vector>

#include "lib/core/cells.h"
#include "lib/core/pattern.h"
#include "lib/fem/dof_map.h"

namespace orthodyn {

class Subdomain;

using NodePairs = std::vector<std::pair<int, int>>;

class BlockPattern {
 public:
  // Couples the nodes of each cell, and the node pairs in `further`, tied nodes by their leaders. `symmetric`: store
  // the lower triangle only. `dofs` must outlive the pattern. Throws ConfigError for more than 2^31 entries.
  BlockPattern(const Cells& cells, const DofMap& dofs, bool symmetric, const NodePairs& further = {});

  const Pattern& pattern() const { return pattern_; }
  // For several ranks: numbers the rows of the global matrix, rank by rank. Collective.
  void set_share(const Subdomain& subdomain);
  bool symmetric() const { return pattern_.symmetric; }

  // Position of node a's first row in the first column of node b, relative to the start of the column. Precondition:
  // the nodes are coupled; a >= b in a symmetric pattern. The result is unspecified if either node has no unknowns.
  int offset(int a, int b) const;

  // Adds a 3x3 block to block (a, b) of the matrix; `offset` is offset(a, b). Blocks of tied nodes are added to those
  // of their leaders.
  void add(int a, int b, int offset, const Mat3& block, double* values) const;

  // Whether all coordinates of a node are unknowns. Only for symmetric patterns, like the two functions below.
  bool is_free(int node) const { return columns_[static_cast<std::size_t>(node)].length > 0; }
  // Branch-free add() to block (a, b), a > b, of two free nodes. Entry (r, c) of the block is at block[r * rows + c *
  // columns].
  void add_free(int b, int offset, const double* block, int rows, int columns, double* values) const;
  // Likewise for the lower triangle of the diagonal block of a free node.
  void add_free_diagonal(int node, const double* block, int rows, int columns, double* values) const;

 private:
  // Start and length of the first column of a free node in a symmetric pattern; 0 for other nodes.
  struct Columns {
    int start = 0, length = 0;
  };
  void add_to_leaders(int a, int b, const Mat3& block, double* values) const;
  const Columns& columns_of(int node) const { return columns_[static_cast<std::size_t>(node)]; }
  void find_columns();

  const DofMap& dofs_;
  Pattern pattern_;
  std::vector<Columns> columns_;
};

// A node's second and third columns are one and two entries shorter than its first, because entries above the diagonal
// are not stored.
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
