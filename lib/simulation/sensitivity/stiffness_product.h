// K x of a model about a state, for derivatives of modes.
#pragma once

#include "lib/ode/model.h"

namespace orthodyn {

// Returns K x about q at time t (s) as a central difference of forces with the largest displacement `small` (m). It has
// fewer rounding errors than the product with the matrix, because forces are computed from the strains of each element.
Vector stiffness_times(const Model& model, double t, const Vector& q, const Vector& x, double small);

}  // namespace orthodyn
