#include "lib/petsc/block_matrix.h"

#include <cmath>
#include <limits>

#include "lib/core/errors.h"

namespace orthodyn::petsc {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// visit(row, column, k) for each entry k of the pattern's triangle.
template <class Visit>
void for_each_entry(const Pattern& pattern, Visit&& visit) {
  for (int j = 0; j < pattern.n; ++j)
    for (int k = pattern.column_start[at(j)]; k < pattern.column_start[at(j) + 1]; ++k)
      visit(pattern.row[at(k)], j, at(k));
}

}  // namespace

BlockMatrix::BlockMatrix(const Pattern& pattern) : place_(at(pattern.n)) {
  const bool has_points = !pattern.coordinate.empty();
  int point = -1, points = 0;
  for (int i = 0; i < pattern.n; ++i) {
    if (!has_points) {
      place_[at(i)] = i;
      continue;
    }
    if (const int now = pattern.coordinate[at(i)] / 3; now != point) point = now, ++points;
    place_[at(i)] = 3 * (points - 1) + pattern.coordinate[at(i)] % 3;
  }
  rows_ = has_points ? 3 * points : pattern.n;

  std::vector<std::size_t> length(at(rows_), 0);
  for_each_entry(pattern, [&](int i, int j, std::size_t) {
    ++length[at(place_[at(i)])];
    if (i != j) ++length[at(place_[at(j)])];
  });
  std::size_t entries = 0;
  start_.push_back(0);
  for (const std::size_t row : length) {
    entries += std::max<std::size_t>(row, 1);
    if (entries > at(std::numeric_limits<PetscInt>::max()))
      throw RunError("the matrix has more than 2^31 entries; use a coarser mesh");
    start_.push_back(static_cast<PetscInt>(entries));
  }
  column_.resize(entries);
  values_.assign(entries, 0);
  next_.assign(start_.begin(), start_.end() - 1);
  // Columns of the triangle ascend, and so do rows in each: each row is filled from left to right.
  for_each_entry(pattern, [&](int i, int j, std::size_t) {
    const PetscInt row = place_[at(i)], column = place_[at(j)];
    column_[at(next_[at(row)]++)] = column;
    if (i != j) column_[at(next_[at(column)]++)] = row;
  });
  for (int row = 0; row < rows_; ++row)
    if (length[at(row)] == 0) {
      column_[at(start_[at(row)])] = row;
      values_[at(start_[at(row)])] = 1;
    }
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, rows_, rows_, start_.data(), column_.data(), values_.data(),
                                  &matrix_));
  if (has_points) check(MatSetBlockSize(matrix_, 3));
  check(MatSetOption(matrix_, MAT_SYMMETRIC, PETSC_TRUE));
}

BlockMatrix::~BlockMatrix() { static_cast<void>(MatDestroy(&matrix_)); }

bool BlockMatrix::set(const Pattern& pattern, const double* values) {
  std::copy(start_.begin(), start_.end() - 1, next_.begin());
  bool usable = true;
  double* into = nullptr;  // values_, of which PETSc learns in this way that they change
  check(MatSeqAIJGetArray(matrix_, &into));
  for_each_entry(pattern, [&](int i, int j, std::size_t k) {
    const double value = values[k];
    if (i == j ? !(value > 0) || !std::isfinite(value) : !std::isfinite(value)) usable = false;
    const auto row = at(place_[at(i)]), column = at(place_[at(j)]);
    into[next_[row]++] = value;
    if (i != j) into[next_[column]++] = value;
  });
  check(MatSeqAIJRestoreArray(matrix_, &into));
  return usable;
}

void BlockMatrix::set_rigid_motions(const Eigen::MatrixXd& motions) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows_, motions.cols());
  for (std::size_t i = 0; i < place_.size(); ++i) all.row(place_[i]) = motions.row(static_cast<Eigen::Index>(i));
  const Eigen::HouseholderQR<Eigen::MatrixXd> orthonormal(all);
  all = orthonormal.householderQ() * Eigen::MatrixXd::Identity(all.rows(), all.cols());
  std::vector<Vec> columns(at(static_cast<int>(all.cols())), nullptr);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    check(MatCreateVecs(matrix_, &columns[c], nullptr));
    double* into = nullptr;
    check(VecGetArray(columns[c], &into));
    Eigen::Map<Vector>(into, rows_) = all.col(static_cast<Eigen::Index>(c));
    check(VecRestoreArray(columns[c], &into));
  }
  MatNullSpace space = nullptr;
  check(MatNullSpaceCreate(PETSC_COMM_SELF, PETSC_FALSE, static_cast<PetscInt>(columns.size()), columns.data(),
                           &space));
  check(MatSetNearNullSpace(matrix_, space));
  check(MatNullSpaceDestroy(&space));
  for (Vec& column : columns) check(VecDestroy(&column));
}

void BlockMatrix::scatter(const ConstVectorRef& x, Vec out) const {
  double* into = nullptr;
  check(VecGetArray(out, &into));
  std::fill(into, into + rows_, 0.0);
  for (std::size_t i = 0; i < place_.size(); ++i) into[place_[i]] = x[static_cast<Eigen::Index>(i)];
  check(VecRestoreArray(out, &into));
}

void BlockMatrix::gather(Vec x, VectorRef out) const {
  const double* from = nullptr;
  check(VecGetArrayRead(x, &from));
  for (std::size_t i = 0; i < place_.size(); ++i) out[static_cast<Eigen::Index>(i)] = from[place_[i]];
  check(VecRestoreArrayRead(x, &from));
}

std::size_t BlockMatrix::bytes() const {
  return values_.size() * (sizeof(double) + sizeof(PetscInt)) +
         (place_.size() + 2 * start_.size()) * sizeof(PetscInt);
}

}  // namespace orthodyn::petsc
