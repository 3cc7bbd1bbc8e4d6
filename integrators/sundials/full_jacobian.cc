#include "integrators/sundials/full_jacobian.h"

#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include "lib/linear/solver.h"

namespace orthodyn::sundials {

namespace {

const bool klu_full_registered =
    solver_registry()
        .emplace("klu_full", SolverKind{"SUNDIALS' sparse matrix and KLU on the full 2n x 2n system: the textbook "
                                        "method, for comparison; symmetric or not.",
                                        true, nullptr})
        .second;

}  // namespace

FullJacobian::FullJacobian(const Model& model)
    : model_(model), full_v_block_(model.traits().damping_matrix || !model.traits().lumped_mass) {
  if (model.ranks())
    throw ConfigError("linear solver 'klu_full' does not run on several ranks; leave it out, or use petsc");
  // Eigen expands the pattern to both triangles. The values that it expands along with it are the indices of the
  // entries.
  const Pattern& p = model.pattern();
  std::vector<double> place(p.row.size());
  for (std::size_t k = 0; k < place.size(); ++k) place[k] = static_cast<double>(k);
  const auto stored = p.matrix(place.data());
  const SparseMatrix all = p.symmetric ? SparseMatrix(stored.selfadjointView<Eigen::Lower>()) : SparseMatrix(stored);
  column_start_.assign(all.outerIndexPtr(), all.outerIndexPtr() + all.cols() + 1);
  row_.assign(all.innerIndexPtr(), all.innerIndexPtr() + all.nonZeros());
  for (Eigen::Index k = 0; k < all.nonZeros(); ++k) source_.push_back(static_cast<int>(all.valuePtr()[k]));
  k_values_.resize(p.row.size());
  d_values_.resize(p.row.size());
}

OwnedMatrix FullJacobian::make_matrix(SUNContext context) const {
  const sunindextype n = model_.num_dofs();
  const auto block = static_cast<sunindextype>(row_.size());
  OwnedMatrix J(SUNSparseMatrix(2 * n, 2 * n, 2 * n + block + (full_v_block_ ? block : n), CSC_MAT, context));
  if (!J)
    throw RunError("the 2n x 2n Jacobian does not fit in memory; use linear_solver: cholesky", Reason::out_of_memory);
  return J;
}

void FullJacobian::fill_first_order(const Linearization& at, SUNMatrix J) {
  Vector inverse_mass = Vector::Ones(model_.num_dofs());
  model_.solve_mass(inverse_mass);
  model_.combine({0, 0, -1}, at, k_values_.data());
  model_.combine({0, -1, 0}, at, d_values_.data());
  fill(J, 0, 1, k_values_, d_values_, inverse_mass);
}

void FullJacobian::fill_ida(double cj, const Linearization& at, SUNMatrix J) {
  model_.combine({0, 0, 1}, at, k_values_.data());
  model_.combine({cj, 1, 0}, at, d_values_.data());
  fill(J, cj, -1, k_values_, d_values_, Vector::Ones(model_.num_dofs()));
}

void FullJacobian::fill(SUNMatrix J, double q_diagonal, double v_identity, const std::vector<double>& qq,
                        const std::vector<double>& vv, const Vector& row_scale) const {
  sunindextype* start = SUNSparseMatrix_IndexPointers(J);
  sunindextype* row = SUNSparseMatrix_IndexValues(J);
  sunrealtype* value = SUNSparseMatrix_Data(J);
  sunindextype at = 0;
  const int n = model_.num_dofs();
  const auto put = [&](int i, double x) {
    row[at] = i;
    value[at++] = x;
  };
  const auto put_block = [&](int column, const std::vector<double>& values, bool diagonal_only) {
    for (int k = column_start_[static_cast<std::size_t>(column)];
         k < column_start_[static_cast<std::size_t>(column) + 1]; ++k) {
      const int i = row_[static_cast<std::size_t>(k)];
      if (diagonal_only && i != column) continue;
      const int from = source_[static_cast<std::size_t>(k)];
      put(n + i, row_scale[i] * values[static_cast<std::size_t>(from)]);
    }
  };
  for (int j = 0; j < n; ++j) {
    start[j] = at;
    put(j, q_diagonal);
    put_block(j, qq, false);
  }
  for (int j = 0; j < n; ++j) {
    start[n + j] = at;
    put(j, v_identity);
    put_block(j, vv, !full_v_block_);
  }
  start[2 * n] = at;
}

OwnedSolver make_klu(SUNMatrix A, SUNContext context) {
  const auto y = make_vector(SUNSparseMatrix_Rows(A), context);
  OwnedSolver solver(SUNLinSol_KLU(y.get(), A, context));
  if (!solver) throw RunError("SUNDIALS could not create its KLU solver");
  SUNLinSol_KLUSetOrdering(solver.get(), 0);  // AMD; the default COLAMD is about twice as slow here
  SUNLinSolInitialize(solver.get());
  return solver;
}

std::size_t klu_factor_bytes(SUNLinearSolver klu) {
  const auto* numeric = klu ? SUNLinSol_KLUGetNumeric(klu) : nullptr;
  if (!numeric) return 0;
  return static_cast<std::size_t>(numeric->lnz + numeric->unz) * (sizeof(double) + sizeof(sunindextype));
}

}  // namespace orthodyn::sundials
