// Eigenvalues of dense symmetric matrices by Eigen's solvers (QR after tridiagonalisation, Golub & Van Loan, Matrix
// Computations, 8.3). The templates are instantiated in the .cc file for N = 3, 6 and Eigen::Dynamic only, since each
// instantiation takes seconds to compile. Only the lower triangle is read. Eigenvalues ascend and have the unit of A,
// or of A/B in the generalised problem. Thread-safe. Values and vectors are NaN if the iteration does not converge, for
// example because an entry is not finite.
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

// Generalised problem A x = lambda B x, B positive definite; the vectors are B-orthonormal.
SymmetricEigenpairs<Eigen::Dynamic> symmetric_eigenpairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
Vector symmetric_eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace orthodyn
