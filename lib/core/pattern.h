// The sparsity pattern shared by the matrices of a model; values are stored separately.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lib/core/ranks.h"
#include "lib/core/types.h"

namespace orthodyn {

// Maps a rank's matrix to the global matrix, which is the sum of the matrices of all ranks. Each rank's matrix has its
// own pattern. The global matrix has three rows per point; the rows of constrained coordinates are those of the
// identity.
struct PatternShare {
  const Ranks* ranks;
  int owned;                      // number of owned unknowns, which come first; vectors hold only these
  int owned_points;               // number of points that the owned unknowns belong to
  std::int64_t first_point;       // global number of the first owned point
  std::vector<std::int64_t> row;  // global row of each unknown
  std::int64_t unknowns;          // number of unknowns of all ranks
};

// Compressed columns, with ascending rows in each column and every diagonal entry stored.
struct Pattern {
  int n = 0;
  bool symmetric = true;          // only the lower triangle is stored
  std::vector<int> column_start;  // start of each column in `row`, and the end of the last; n + 1 entries
  std::vector<int> row;
  // For each unknown: 3 * point + component, ascending; empty if the unknowns are not coordinates of points. Unknowns
  // of one point have entries in the same rows.
  std::vector<int> coordinate;
  std::shared_ptr<const PatternShare> share = {};  // null if the matrix is not distributed over ranks

  int non_zeros() const { return static_cast<int>(row.size()); }

  Eigen::Map<const SparseMatrix> matrix(const double* values) const {
    return {n, n, non_zeros(), column_start.data(), row.data(), values};
  }

  // Computes y = A x; x and y are different vectors of size n.
  void multiply(const double* values, const ConstVectorRef& x, VectorRef y) const;
};

}  // namespace orthodyn
