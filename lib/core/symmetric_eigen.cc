#include "lib/core/symmetric_eigen.h"

#include <Eigen/Eigenvalues>
#include <limits>

namespace orthodyn {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class Solver>
auto values_of(const Solver& solver) {
  auto values = solver.eigenvalues();
  if (solver.info() != Eigen::Success) values.setConstant(kNaN);
  return values;
}

template <int N, class Solver>
SymmetricEigenpairs<N> pairs_of(const Solver& solver) {
  SymmetricEigenpairs<N> pairs{values_of(solver), solver.eigenvectors()};
  if (solver.info() != Eigen::Success) pairs.vectors.setConstant(kNaN);
  return pairs;
}

}  // namespace

template <int N>
ColumnVector<N> symmetric_eigenvalues(const SquareMatrix<N>& A) {
  return values_of(Eigen::SelfAdjointEigenSolver<SquareMatrix<N>>(A, Eigen::EigenvaluesOnly));
}

template <int N>
SymmetricEigenpairs<N> symmetric_eigenpairs(const SquareMatrix<N>& A) {
  return pairs_of<N>(Eigen::SelfAdjointEigenSolver<SquareMatrix<N>>(A));
}

template ColumnVector<3> symmetric_eigenvalues(const SquareMatrix<3>&);
template ColumnVector<6> symmetric_eigenvalues(const SquareMatrix<6>&);
template ColumnVector<Eigen::Dynamic> symmetric_eigenvalues(const SquareMatrix<Eigen::Dynamic>&);
template SymmetricEigenpairs<3> symmetric_eigenpairs(const SquareMatrix<3>&);
template SymmetricEigenpairs<6> symmetric_eigenpairs(const SquareMatrix<6>&);
template SymmetricEigenpairs<Eigen::Dynamic> symmetric_eigenpairs(const SquareMatrix<Eigen::Dynamic>&);

SymmetricEigenpairs<Eigen::Dynamic> symmetric_eigenpairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return pairs_of<Eigen::Dynamic>(Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, B));
}

Vector symmetric_eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return values_of(Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, B, Eigen::EigenvaluesOnly));
}

}  // namespace orthodyn
