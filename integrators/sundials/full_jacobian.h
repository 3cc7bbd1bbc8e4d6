// `klu_full`: the sparse 2n x 2n Jacobian of the first-order system, for SUNDIALS' KLU. The textbook method, kept for
// comparison.
//
// CVODE and ARKODE, y' = (v, M^-1 f):  J = [0, I; -M^-1 K, -M^-1 D]          (lumped mass only)
// IDA, F = (q' - v, M v' - f):  dF/dy + cj dF/dy' = [cj I, -I; K, cj M + D]
#pragma once

#include <vector>

#include "integrators/sundials/handles.h"
#include "lib/ode/model.h"

namespace orthodyn::sundials {

class FullJacobian {
 public:
  explicit FullJacobian(const Model& model);

  OwnedMatrix make_matrix(SUNContext context) const;

  // Write both the pattern and the values of J, because CVODE and IDA erase both before the call. `cj` in 1/s.
  void fill_first_order(const Linearization& at, SUNMatrix J);
  void fill_ida(double cj, const Linearization& at, SUNMatrix J);

 private:
  void fill(SUNMatrix J, double q_diagonal, double v_identity, const std::vector<double>& qq,
            const std::vector<double>& vv, const Vector& row_scale) const;

  const Model& model_;
  bool full_v_block_;              // true if D or M couples unknowns
  std::vector<int> column_start_;  // of the n x n blocks, both triangles
  std::vector<int> row_, source_;  // of each entry: its row, and the index of its value on the model's pattern
  std::vector<double> k_values_, d_values_;
};

// SUNDIALS' KLU with minimum-degree ordering.
OwnedSolver make_klu(SUNMatrix A, SUNContext context);
std::size_t klu_factor_bytes(SUNLinearSolver klu);  // 0 before the first factorisation

}  // namespace orthodyn::sundials
