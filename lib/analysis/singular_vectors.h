// Singular values and right singular vectors of a matrix with few columns, A = U S V^T. One-sided Jacobi rotations are
// applied to pairs of columns until the columns of A V are orthogonal (Hestenes 1958). Small singular values are
// accurate to round-off (Demmel & Veselic 1992); computed from the eigenvalues of A^T A they would lose half of the
// digits.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

struct SingularVectors {
  Vector values;      // singular values, not sorted
  Eigen::MatrixXd V;  // right singular vectors, one column per value
};

SingularVectors right_singular_vectors(Eigen::MatrixXd A);

}  // namespace orthodyn
