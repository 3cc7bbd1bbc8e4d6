// The sparsity pattern of a mesh, and where the 3x3 block of two nodes lies in it.
#pragma once

#include <utility>
#include <vector>

#include "lib/core/pattern.h"
#include "lib/fem/dof_map.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

using NodePairs = std::vector<std::pair<int, int>>;

class BlockPattern {
 public:
  // Couples the nodes of each tet, and the further pairs. `dofs` must outlive the pattern.
  BlockPattern(const std::vector<Tet>& tets, const DofMap& dofs, bool symmetric, const NodePairs& further = {});

  const Pattern& pattern() const { return pattern_; }
  bool symmetric() const { return pattern_.symmetric; }

  // Where node a's rows begin in the first column of node b, relative to that column's start.
  // For a symmetric pattern a >= b. Meaningless if either node has no unknowns.
  int offset(int a, int b) const;

  // values[block (a, b)] += block. `offset` is offset(a, b).
  void add(int a, int b, int offset, const Mat3& block, double* values) const;

 private:
  const DofMap& dofs_;
  Pattern pattern_;
};

}  // namespace orthodyn
