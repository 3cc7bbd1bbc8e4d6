// Eigenvalues of dense symmetric matrices: Eigen's solvers (QR after tridiagonalisation, Golub & Van Loan, Matrix
// Computations, 8.3), compiled once for N = 3, 6 and Eigen::Dynamic, since each use costs seconds of compilation.
// Only the lower triangle is read; values ascend, in the unit of A (of A over B). Thread-safe.
// Values and vectors are NaN where the iteration does not converge, as for entries that are not finite.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

template <int N>
using SquareMatrix = Eigen::Matrix<double, N, N>;
template <int N>
using ColumnVector = Eigen::Matrix<double, N, 1>;

template <int N>
struct SymmetricEigenpairs {
  ColumnVector<N> values;
  SquareMatrix<N> vectors;  // columns, orthonormal
};

template <int N>
ColumnVector<N> symmetric_eigenvalues(const SquareMatrix<N>& A);

template <int N>
SymmetricEigenpairs<N> symmetric_eigenpairs(const SquareMatrix<N>& A);

// Of A x = lambda B x with B positive definite; the vectors are orthonormal in the inner product of B.
SymmetricEigenpairs<Eigen::Dynamic> symmetric_eigenpairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
Vector symmetric_eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace orthodyn
