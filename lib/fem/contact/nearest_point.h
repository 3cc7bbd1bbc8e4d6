// The nearest point of a triangle, and the derivatives of the distance from it.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

using Triangle = Mat3;  // corners as columns, m

// The barycentric coordinates of the foot of x on the plane of a triangle.
Vec3 foot_on_plane(const Vec3& x, const Triangle& triangle);

// The barycentric coordinates of the point of a triangle that is nearest to x. Those of corners that do not matter are
// exactly 0: all are positive inside, two on an edge, one at a corner.
Vec3 nearest_point(const Vec3& x, const Triangle& triangle);

using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

// The distance r > 0 of x from its nearest point p, as a function of z = (x, corners): its gradient is (n, -L_1 n,
// -L_2 n, -L_3 n) with n = (x - p)/r, because the nearest point makes the distance stationary.
//
// second_derivative() is r times the second derivative. With D = r^2/2, y = x - p = B z, the free coordinates m along
// the directions E on the triangle, edge or corner (none): D_zz = B^T B, D_mm = E^T E, D_zm = -B^T E + (dB/dm)^T y, and
// by elimination of m, r r_zz = D_zz - D_zm D_mm^-1 D_mz - r_z r_z^T.
struct Distance {
  Vec3 n;  // unit vector from p to x
  double r;
  Vec3 L;
  Triangle triangle;
  bool on_plane = false;  // p is the nearest point of the plane of the triangle, which may lie beside the triangle

  Vec12 gradient() const;
  Mat12 second_derivative() const;  // m
};

}  // namespace orthodyn
