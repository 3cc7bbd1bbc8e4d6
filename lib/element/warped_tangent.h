// Which tangent the warped force has (warped_law.h): R K R^T, or its exact derivative, which is unsymmetric.
#pragma once

namespace orthodyn {

enum class WarpedTangent { rotated, unsymmetric };

}  // namespace orthodyn
