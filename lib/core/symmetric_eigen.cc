#include "lib/core/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace orthodyn {

template <int N>
ColumnVector<N> symmetric_eigenvalues(const SquareMatrix<N>& A) {
  return Eigen::SelfAdjointEigenSolver<SquareMatrix<N>>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

template <int N>
SymmetricEigenpairs<N> symmetric_eigenpairs(const SquareMatrix<N>& A) {
  const Eigen::SelfAdjointEigenSolver<SquareMatrix<N>> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template ColumnVector<3> symmetric_eigenvalues(const SquareMatrix<3>&);
template ColumnVector<6> symmetric_eigenvalues(const SquareMatrix<6>&);
template ColumnVector<Eigen::Dynamic> symmetric_eigenvalues(const SquareMatrix<Eigen::Dynamic>&);
template SymmetricEigenpairs<3> symmetric_eigenpairs(const SquareMatrix<3>&);
template SymmetricEigenpairs<6> symmetric_eigenpairs(const SquareMatrix<6>&);
template SymmetricEigenpairs<Eigen::Dynamic> symmetric_eigenpairs(const SquareMatrix<Eigen::Dynamic>&);

SymmetricEigenpairs<Eigen::Dynamic> symmetric_eigenpairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, B);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Vector symmetric_eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, B, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace orthodyn
