// The sparsity pattern that the matrices of a model share; values are kept apart from it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lib/core/ranks.h"
#include "lib/core/types.h"

namespace orthodyn {

// How the matrices of several ranks, each on a pattern of its own, make up one: it is their sum. Every point has three
// rows in it, those of a coordinate that is no unknown are of the identity.
struct PatternShare {
  const Ranks* ranks;
  int owned;                      // the first so many unknowns are this rank's, and vectors have these alone
  int owned_points;               // the points that they are coordinates of
  std::int64_t first_point;       // the number of the first of these among all
  std::vector<std::int64_t> row;  // of each unknown its row in the whole
  std::int64_t unknowns;          // of the whole
};

// Column-compressed, rows ascending in each column, the diagonal always present.
struct Pattern {
  int n = 0;
  bool symmetric = true;          // only the lower triangle is stored
  std::vector<int> column_start;  // n + 1
  std::vector<int> row;
  // Of unknowns that are coordinates of points, ascending: 3 point + coordinate. Empty for others.
  std::vector<int> coordinate;
  // Where several ranks have parts of the matrix; null where it is whole.
  std::shared_ptr<const PatternShare> share = {};

  int non_zeros() const { return static_cast<int>(row.size()); }

  Eigen::Map<const SparseMatrix> matrix(const double* values) const {
    return {n, n, non_zeros(), column_start.data(), row.data(), values};
  }

  // y = A x
  void multiply(const double* values, const ConstVectorRef& x, VectorRef y) const {
    if (symmetric) y = matrix(values).selfadjointView<Eigen::Lower>() * x;
    else y = matrix(values) * x;
  }
};

}  // namespace orthodyn
