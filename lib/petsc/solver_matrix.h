// A symmetric matrix of a model for PETSc: both triangles, by rows, in blocks of three. Multigrid identifies the three
// coordinates of a point by their place in a block, so constrained coordinates have rows, too: rows of the identity.
#pragma once

#include <memory>
#include <vector>

#include "lib/core/pattern.h"
#include "lib/petsc/handle.h"
#include "lib/petsc/session.h"

namespace orthodyn::petsc {

class SolverMatrix {
 public:
  // Makes the matrix for a pattern of one process (block_matrix.cc) or a distributed pattern (shared_matrix.cc). For a
  // distributed pattern all functions are collective. Precondition: the pattern is symmetric. Throws RunError for more
  // than 2^31 entries.
  static std::unique_ptr<SolverMatrix> of(const Pattern& pattern);

  virtual ~SolverMatrix() = default;
  SolverMatrix(const SolverMatrix&) = delete;
  SolverMatrix& operator=(const SolverMatrix&) = delete;

  // Sets the values. False if a value is not finite or a diagonal entry is not positive; the matrix must then not be
  // used.
  virtual bool set(const Pattern& pattern, const double* values) = 0;

  // Gives multigrid the rigid motions. `motions`: n x 6, in the order of the unknowns.
  void set_rigid_motions(const Eigen::MatrixXd& motions);

  Mat get() const { return matrix_; }
  int rows() const { return rows_; }  // rows of this rank
  int fewest_unknowns() const;        // smallest number of unknowns of a rank
  // Copy between vectors of unknowns and PETSc's vectors.
  void scatter(const ConstVectorRef& x, Vec out) const;
  void gather(Vec x, VectorRef out) const;

  virtual std::size_t bytes() const = 0;

 protected:
  SolverMatrix() = default;

  OwnedMatrix matrix_;
  int rows_ = 0;
  std::vector<PetscInt> place_;  // local row of each unknown
};

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Calls visit(row, column, k) for each entry k of a pattern's triangle.
template <class Visit>
void for_each_entry(const Pattern& pattern, Visit&& visit) {
  for (int j = 0; j < pattern.n; ++j)
    for (int k = pattern.column_start[at(j)]; k < pattern.column_start[at(j) + 1]; ++k)
      visit(pattern.row[at(k)], j, at(k));
}

std::unique_ptr<SolverMatrix> make_block_matrix(const Pattern& pattern);
std::unique_ptr<SolverMatrix> make_shared_matrix(const Pattern& pattern);

}  // namespace orthodyn::petsc
