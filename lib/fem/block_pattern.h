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
  bool symmetric() const { return pattern_.symmetric; }

  // Where node a's rows begin in the first column of node b, relative to that column's start.
  // Precondition: the nodes are coupled; for a symmetric pattern a >= b. Meaningless if either has no unknowns.
  int offset(int a, int b) const;

  // values[block (a, b)] += block. `offset` is offset(a, b).
  void add(int a, int b, int offset, const Mat3& block, double* values) const;

 private:
  const DofMap& dofs_;
  Pattern pattern_;
};

}  // namespace orthodyn
