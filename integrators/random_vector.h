// Vectors that are in no body's symmetry.
#pragma once

#include "lib/ode/model.h"

namespace orthodyn {

// Entries between -1/2 and 1/2 for each unknown, the same each time, whatever ranks hold the model.
Vector random_vector(const Model& model);

}  // namespace orthodyn
