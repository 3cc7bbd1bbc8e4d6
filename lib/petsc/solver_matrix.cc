#include "lib/petsc/solver_matrix.h"

#include <algorithm>

namespace orthodyn::petsc {

namespace {

// Orthonormalises columns by two passes of Gram-Schmidt. Columns that depend on earlier ones become zero.
void orthonormalize(const std::vector<OwnedVector>& columns) {
  constexpr double kDependent = 1e-8;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    double before = 0, after = 0;
    check(VecNorm(columns[c], NORM_2, &before));
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t k = 0; k < c; ++k) {
        double share = 0;
        check(VecDot(columns[c], columns[k], &share));
        check(VecAXPY(columns[c], -share, columns[k]));
      }
    check(VecNorm(columns[c], NORM_2, &after));
    check(VecScale(columns[c], after > kDependent * before ? 1 / after : 0));
  }
}

bool is_zero(Vec x) {
  double size = 0;
  check(VecNorm(x, NORM_INFINITY, &size));
  return size == 0;
}

}  // namespace

std::unique_ptr<SolverMatrix> SolverMatrix::of(const Pattern& pattern) {
  return pattern.share ? make_shared_matrix(pattern) : make_block_matrix(pattern);
}

void SolverMatrix::set_rigid_motions(const Eigen::MatrixXd& motions) {
  std::vector<OwnedVector> columns(static_cast<std::size_t>(motions.cols()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    check(MatCreateVecs(matrix_, columns[c].receive(), nullptr));
    scatter(motions.col(static_cast<Eigen::Index>(c)), columns[c]);
  }
  orthonormalize(columns);
  std::vector<Vec> independent;
  for (const OwnedVector& column : columns)
    if (!is_zero(column)) independent.push_back(column);
  OwnedNullSpace space;
  check(MatNullSpaceCreate(PetscObjectComm(reinterpret_cast<PetscObject>(matrix_.get())), PETSC_FALSE,
                           static_cast<PetscInt>(independent.size()), independent.data(), space.receive()));
  check(MatSetNearNullSpace(matrix_, space));
}

int SolverMatrix::fewest_unknowns() const {
  int fewest = static_cast<int>(place_.size());
  const MPI_Comm ranks = PetscObjectComm(reinterpret_cast<PetscObject>(matrix_.get()));
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &fewest, 1, MPI_INT, MPI_MIN, ranks));
  return fewest;
}

void SolverMatrix::scatter(const ConstVectorRef& x, Vec out) const {
  double* into = nullptr;
  check(VecGetArray(out, &into));
  std::fill(into, into + rows_, 0.0);
  for (std::size_t i = 0; i < place_.size(); ++i) into[place_[i]] = x[static_cast<Eigen::Index>(i)];
  check(VecRestoreArray(out, &into));
}

void SolverMatrix::gather(Vec x, VectorRef out) const {
  const double* from = nullptr;
  check(VecGetArrayRead(x, &from));
  for (std::size_t i = 0; i < place_.size(); ++i) out[static_cast<Eigen::Index>(i)] = from[place_[i]];
  check(VecRestoreArrayRead(x, &from));
}

}  // namespace orthodyn::petsc
