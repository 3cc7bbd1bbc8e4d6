// A symmetric matrix of a model as PETSc takes it: all of it, by rows, in blocks of three. What multigrid knows of a
// point's three coordinates it knows from their places: coordinates that are held have rows of their own, of the
// identity.
#pragma once

#include <memory>
#include <vector>

#include "lib/core/pattern.h"
#include "lib/petsc/handle.h"
#include "lib/petsc/session.h"

namespace orthodyn::petsc {

class SolverMatrix {
 public:
  // Of a pattern that is whole (block_matrix.cc), or of one of those of several ranks (shared_matrix.cc); then it is
  // collective, as is all else. Precondition: the pattern is symmetric. Throws RunError for more than 2^31 entries.
  static std::unique_ptr<SolverMatrix> of(const Pattern& pattern);

  virtual ~SolverMatrix() = default;
  SolverMatrix(const SolverMatrix&) = delete;
  SolverMatrix& operator=(const SolverMatrix&) = delete;

  // False if a value is not finite, or one of the diagonal not positive: the matrix then is not to be used.
  virtual bool set(const Pattern& pattern, const double* values) = 0;

  // The six columns, n x 6, in the order of the unknowns.
  void set_rigid_motions(const Eigen::MatrixXd& motions);

  Mat get() const { return matrix_; }
  int rows() const { return rows_; }  // of this rank
  int fewest_unknowns() const;        // of a rank
  // Between the unknowns and PETSc's vectors.
  void scatter(const ConstVectorRef& x, Vec out) const;
  void gather(Vec x, VectorRef out) const;

  virtual std::size_t bytes() const = 0;

 protected:
  SolverMatrix() = default;

  OwnedMatrix matrix_;
  int rows_ = 0;
  std::vector<PetscInt> place_;  // of each unknown its row among those of this rank
};

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

// visit(row, column, k) for each entry k of a pattern's triangle.
template <class Visit>
void for_each_entry(const Pattern& pattern, Visit&& visit) {
  for (int j = 0; j < pattern.n; ++j)
    for (int k = pattern.column_start[at(j)]; k < pattern.column_start[at(j) + 1]; ++k)
      visit(pattern.row[at(k)], j, at(k));
}

std::unique_ptr<SolverMatrix> make_block_matrix(const Pattern& pattern);
std::unique_ptr<SolverMatrix> make_shared_matrix(const Pattern& pattern);

}  // namespace orthodyn::petsc
