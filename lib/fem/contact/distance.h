// The distance r > 0 of a point from a triangle, or of two segments, and its derivatives by the positions z_1 to z_4 of
// their nodes.
//
// The nearest points differ by y = sum_k share_k z_k = r n. They make the distance stationary, so that its gradient is
// (share_k n). second_derivative() is r times the second derivative. With D = r^2/2, the matrix B of y = B z and the
// coordinates m of the nearest points inside a triangle or along edges, which change the shares by `moves`: D_zz = B^T
// B, D_mm = (dy/dm)^T dy/dm, D_zm = B^T dy/dm + (dB/dm)^T y, and by elimination of m, r r_zz = D_zz - D_zm D_mm^-1 D_mz
// - r_z r_z^T.
#pragma once

#include "lib/fem/contact/nearest_point.h"

namespace orthodyn {

using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

struct Distance {
  Vec3 n;  // unit vector along y
  double r;
  Eigen::Vector4d share;
  Eigen::Matrix<double, 3, 4> z;                                 // m
  Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 2> moves = {};  // derivatives of the shares by m

  // False for a point that has no part in the distance, as the third corner of a triangle whose edge is nearest.
  bool has_point(int k) const { return share[k] != 0 || (moves.cols() > 0 && !moves.row(k).isZero(0)); }

  Vec12 gradient() const;
  Mat12 second_derivative() const;  // m
};

// The distance of x from the point of a triangle with the barycentric coordinates L. Coordinates that are 0 stay so,
// unless the point is the nearest one of the whole plane (`on_plane`), which may lie beside the triangle.
Distance distance_of(const Vec3& x, const Triangle& triangle, const Vec3& L, bool on_plane = false);

// The distance of two segments at their nearest places.
Distance distance_of(const Segment& first, const Segment& second, const NearestPlaces& places);

}  // namespace orthodyn
