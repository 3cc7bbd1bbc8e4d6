// Vectors at the nodes of a mesh.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

using NodalVector = Eigen::Matrix<double, 3, Eigen::Dynamic>;  // one column per node

}  // namespace orthodyn
