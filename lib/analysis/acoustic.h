// Whether waves of every direction travel at a deformed point: strong ellipticity of the corotational law.
//
// The acoustic tensor of direction n is A_ac = H_abcd n_b n_d with H = d2Psi/dF2 (exact_form); the law is
// strongly elliptic where A is positive definite for all n. Looked for on a half sphere of samples, about
// 7 degrees apart, that holds the axes.
#pragma once

#include "lib/element/tangent_form.h"

namespace orthodyn {

// Of a symmetric matrix, by its leading minors.
bool is_positive_definite(const Mat3& A);

// H acting on dF in the rotated frame (expand()).
bool is_strongly_elliptic(const Mat9& H);

}  // namespace orthodyn
