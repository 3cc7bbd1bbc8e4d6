// The sparsity pattern that the matrices of a model share; values are kept apart from it.
#pragma once

#include <vector>

#include "lib/core/types.h"

namespace orthodyn {

// Column-compressed, rows ascending in each column, the diagonal always present.
struct Pattern {
  int n = 0;
  bool symmetric = true;          // only the lower triangle is stored
  std::vector<int> column_start;  // n + 1
  std::vector<int> row;
  // Of unknowns that are coordinates of points, ascending: 3 point + coordinate. Empty for others.
  std::vector<int> coordinate;

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
