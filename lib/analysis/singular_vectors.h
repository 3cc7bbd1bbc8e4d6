// The singular value decomposition of a matrix of few columns, A = U S V', without U: one-sided Jacobi rotations of
// pairs of columns until those of A V are orthogonal (Hestenes 1958). Small singular values have their digits, too
// (Demmel & Veselic 1992); those of A'A would be squared, below round-off.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

struct SingularVectors {
  Vector values;      // in no order
  Eigen::MatrixXd V;  // a column for each
};

SingularVectors right_singular_vectors(Eigen::MatrixXd A);

}  // namespace orthodyn
