// A symmetric matrix of a model as PETSc takes it: all of it, by rows, in blocks of three. What multigrid knows of a
// point's three coordinates it knows from their places: coordinates that are held have rows of their own, of the
// identity. Values are this object's, which PETSc reads where they are.
#pragma once

#include <vector>

#include "lib/core/pattern.h"
#include "lib/petsc/session.h"

namespace orthodyn::petsc {

class BlockMatrix {
 public:
  // Precondition: the pattern is symmetric. Throws RunError for more than 2^31 entries.
  explicit BlockMatrix(const Pattern& pattern);
  ~BlockMatrix();
  BlockMatrix(const BlockMatrix&) = delete;
  BlockMatrix& operator=(const BlockMatrix&) = delete;

  // False if a value is not finite, or one of the diagonal not positive: the matrix then is not to be used.
  bool set(const Pattern& pattern, const double* values);

  // The six columns, n x 6, in the order of the unknowns.
  void set_rigid_motions(const Eigen::MatrixXd& motions);

  Mat get() const { return matrix_; }
  int rows() const { return rows_; }
  // Between the unknowns and PETSc's vectors.
  void scatter(const ConstVectorRef& x, Vec out) const;
  void gather(Vec x, VectorRef out) const;

  std::size_t bytes() const;

 private:
  int rows_ = 0;
  std::vector<PetscInt> place_;  // of each unknown its row
  std::vector<PetscInt> start_, column_, next_;
  std::vector<double> values_;
  Mat matrix_ = nullptr;
};

}  // namespace orthodyn::petsc
