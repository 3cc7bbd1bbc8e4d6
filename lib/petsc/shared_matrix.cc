// The solver matrix of a distributed model: PETSc sums the ranks' entries, and each rank stores the rows of its points.
#include <cmath>
#include <limits>

#include "lib/core/errors.h"
#include "lib/petsc/solver_matrix.h"

namespace orthodyn::petsc {

namespace {

class SharedMatrix : public SolverMatrix {
 public:
  explicit SharedMatrix(const Pattern& pattern) {
    const PatternShare& share = *pattern.share;
    const std::int64_t first = 3 * share.first_point;
    rows_ = 3 * share.owned_points;
    if (any_rank(PETSC_COMM_WORLD, first + rows_ > std::numeric_limits<PetscInt>::max()))
      throw RunError("the matrix has more than 2^31 rows; use a coarser mesh");
    for (int i = 0; i < share.owned; ++i) place_.push_back(static_cast<PetscInt>(share.row[at(i)] - first));

    std::vector<PetscInt> row, column;
    for_each_entry(pattern, [&](int i, int j, std::size_t) {
      row.push_back(to_index(share.row[at(i)]));
      column.push_back(to_index(share.row[at(j)]));
      if (i == j) return;
      row.push_back(to_index(share.row[at(j)]));
      column.push_back(to_index(share.row[at(i)]));
    });
    std::vector<char> is_free(at(rows_), 0);
    for (const PetscInt place : place_) is_free[at(place)] = 1;
    for (int k = 0; k < rows_; ++k)
      if (is_free[at(k)] == 0) {
        row.push_back(to_index(first + k));
        column.push_back(row.back());
      }
    values_.assign(row.size(), 1);
    check(MatCreate(PETSC_COMM_WORLD, matrix_.receive()));
    check(MatSetSizes(matrix_, rows_, rows_, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetType(matrix_, MATMPIAIJ));
    check(MatSetBlockSize(matrix_, 3));
    check(MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(row.size()), row.data(), column.data()));
    Mat own = nullptr;  // the diagonal block of this rank, which needs the block size for block preconditioners
    check(MatGetDiagonalBlock(matrix_, &own));
    check(MatSetBlockSize(own, 3));
    check(MatSetOption(matrix_, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatCreateVecs(matrix_, diagonal_.receive(), nullptr));
  }

  bool set(const Pattern& pattern, const double* values) override {
    bool is_finite = true;
    std::size_t next = 0;
    for_each_entry(pattern, [&](int i, int j, std::size_t k) {
      is_finite = is_finite && std::isfinite(values[k]);
      values_[next++] = values[k];
      if (i != j) values_[next++] = values[k];
    });
    check(MatSetValuesCOO(matrix_, values_.data(), INSERT_VALUES));
    double least = 0;
    check(MatGetDiagonal(matrix_, diagonal_));
    check(VecMin(diagonal_, nullptr, &least));
    return !any_rank(PETSC_COMM_WORLD, !is_finite || !(least > 0));
  }

  // Includes PETSc's data for summing entries.
  std::size_t bytes() const override { return 3 * values_.size() * sizeof(double); }

 private:
  static PetscInt to_index(std::int64_t row) { return static_cast<PetscInt>(row); }

  // In the order of MatSetPreallocationCOO; the last ones, of constrained coordinates, are 1.
  std::vector<double> values_;
  OwnedVector diagonal_;
};

}  // namespace

std::unique_ptr<SolverMatrix> make_shared_matrix(const Pattern& pattern) {
  return std::make_unique<SharedMatrix>(pattern);
}

}  // namespace orthodyn::petsc
