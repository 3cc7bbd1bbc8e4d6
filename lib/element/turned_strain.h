// The strain e = S - I of batches in material axes, its change and the stiffness of a stress C:e, for laws beside the
// elastic one. H and Q as in corotational_law.h. Lanes with blended or inverted states (blend.h) have strains, but no
// change and no stiffness: they serve Newton's method, which then uses an approximate matrix.
#pragma once

#include "lib/element/lanes.h"
#include "lib/element/tangent_form.h"

namespace orthodyn {

Mat3T<Batch> turned_strain(const Mat3T<Batch>& H, const Mat3T<Batch>& Q);
Mat3T<Batch> turned_strain_change(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, const Mat3T<Batch>& dH);
// Adds (de/dH)^T C de/dH to K (Pa).
void add_strain_moduli(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, const AnisotropicStiffness& C, Mat9T<Batch>& K);
// The same for the linear strain sym(H).
void add_linear_strain_moduli(const Mat3T<Batch>& Q, const AnisotropicStiffness& C, Mat9T<Batch>& K);

}  // namespace orthodyn
