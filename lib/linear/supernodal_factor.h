// The numeric part of a sparse Cholesky factorisation, P (s A) P^T = L L^T, for T = double or float. For float, s is a
// power of two that brings the largest entry near 1, and right-hand sides are scaled, too; for double s is 1.
//
// Each supernode takes the updates of the earlier ones (left-looking). Independent subtrees run on the threads of
// parallel_for(), then strips of columns of each supernode above them. The order of the operations on each entry is
// always the same, so results do not depend on the number of threads.
#pragma once

#include <vector>

#include "lib/core/types.h"
#include "lib/linear/dense_blocks.h"
#include "lib/linear/supernodes.h"

namespace orthodyn {

template <class T>
class SupernodalFactor {
 public:
  // `supernodes` must outlive this object.
  explicit SupernodalFactor(const Supernodes& supernodes);

  // False if a pivot is not positive. `values`: of the entries of the pattern.
  bool factor(const double* values);

  // x = A^-1 b; both of size n, and may be the same vector. Precondition: the last factor() succeeded.
  void solve(const ConstVectorRef& b, VectorRef x);

  std::size_t bytes() const { return bytes(supernodes_); }
  static std::size_t bytes(const Supernodes& supernodes);

 private:
  // Of one thread.
  struct Workspace {
    std::vector<int> position;  // of rows of P A P^T in the present block
    std::vector<int> rows;      // of an update in the present block
    DenseBlocks<T> dense;
  };
  struct Columns {
    int begin, end;
  };

  bool factor_supernode(int s, const double* values, Workspace& workspace);
  bool factor_top(int s, const double* values);
  void begin_supernode(int s, const double* values, Workspace& workspace);
  // Subtracts the updates of earlier supernodes from some columns of a block.
  void take_updates(int s, Columns columns, const std::vector<int>& position, Workspace& workspace);
  bool finish_supernode(int s, Workspace& workspace);
  T* block(int s) { return values_.data() + supernodes_.blocks[static_cast<std::size_t>(s)]; }

  const Supernodes& supernodes_;
  double scale_ = 1;       // s
  std::vector<T> values_;  // of L
  std::vector<Workspace> workspaces_;
  std::vector<T> y_, below_;  // of a solution
};

}  // namespace orthodyn
