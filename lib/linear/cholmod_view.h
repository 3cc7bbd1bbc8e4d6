// What users of CHOLMOD share: a view of our matrices, and when to order by nested dissection.
#pragma once

#include <cholmod.h>

#include "lib/core/pattern.h"

namespace orthodyn {

// Below this number of unknowns, minimum degree gives as little fill as nested dissection and is faster.
inline constexpr int kNestedDissectionFrom = 50'000;

// The lower triangle of a symmetric matrix, not copied; `values` may be null. CHOLMOD takes non-const pointers but only
// reads.
inline cholmod_sparse cholmod_view(const Pattern& pattern, const double* values) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(pattern.n);
  view.nzmax = pattern.row.size();
  view.p = const_cast<int*>(pattern.column_start.data());
  view.i = const_cast<int*>(pattern.row.data());
  view.x = const_cast<double*>(values);
  view.stype = -1;  // lower triangle
  view.itype = CHOLMOD_INT;
  view.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

}  // namespace orthodyn
