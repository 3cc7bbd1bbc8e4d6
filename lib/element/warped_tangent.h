// The tangent of the warped force (warped_law.h): R K R^T with the stiffness K at rest, or the exact, unsymmetric
// derivative.
#pragma once

namespace orthodyn {

enum class WarpedTangent { rotated, unsymmetric };

}  // namespace orthodyn
