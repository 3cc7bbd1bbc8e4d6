// The solver matrix of a model of one process. The values belong to this object; PETSc reads them in place.
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/errors.h"
#include "lib/petsc/solver_matrix.h"

namespace orthodyn::petsc {

namespace {

class BlockMatrix : public SolverMatrix {
 public:
  explicit BlockMatrix(const Pattern& pattern) {
    place_.resize(at(pattern.n));
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
    // Columns of the triangle ascend, and rows within each column too, so each row is filled from left to right.
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
                                    matrix_.receive()));
    if (has_points) check(MatSetBlockSize(matrix_, 3));
    check(MatSetOption(matrix_, MAT_SYMMETRIC, PETSC_TRUE));
  }

  bool set(const Pattern& pattern, const double* values) override {
    std::copy(start_.begin(), start_.end() - 1, next_.begin());
    bool usable = true;
    double* into = nullptr;  // = values_; PETSc must know that they change
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

  std::size_t bytes() const override {
    return values_.size() * (sizeof(double) + sizeof(PetscInt)) +
           (place_.size() + 2 * start_.size()) * sizeof(PetscInt);
  }

 private:
  std::vector<PetscInt> start_, column_, next_;
  std::vector<double> values_;
};

}  // namespace

std::unique_ptr<SolverMatrix> make_block_matrix(const Pattern& pattern) {
  return std::make_unique<BlockMatrix>(pattern);
}

}  // namespace orthodyn::petsc
