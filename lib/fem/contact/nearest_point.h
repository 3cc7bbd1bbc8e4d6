// Nearest points of points, segments and triangles.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

using Triangle = Mat3;  // corners as columns, m

// The barycentric coordinates of the foot of x on the plane of a triangle.
Vec3 foot_on_plane(const Vec3& x, const Triangle& triangle);

// The barycentric coordinates of the point of a triangle that is nearest to x. Those of corners that do not matter are
// exactly 0: all are positive inside, two on an edge, one at a corner.
Vec3 nearest_point(const Vec3& x, const Triangle& triangle);

// The places of the points of two segments that are nearest to each other, from 0 at the first end of a segment to 1 at
// the second one: exactly 0 or 1 at ends.
struct NearestPlaces {
  double first, second;
};
using Segment = Eigen::Matrix<double, 3, 2>;  // ends as columns, m
NearestPlaces nearest_places(const Segment& first, const Segment& second);

// Whether a segment passes through a triangle or its sides. Segments in its plane do not.
bool pierces(const Segment& segment, const Triangle& triangle);

}  // namespace orthodyn
