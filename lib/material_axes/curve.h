// A smooth curve through points in space, and the nearest point of it.
//
// Between two points the curve is a cubic with the derivatives of the centripetal Catmull-Rom spline (knots
// spaced by the square root of the distance: no cusps and no loops within a piece; Yuksel, Schaefer and
// Keyser 2011); the first and the last piece are parabolas, and a curve through two points is straight. Its
// tangent is continuous. A normal is carried along it without turning about the tangent (rotation
// minimising, by the double reflection of Wang, Juettler, Zheng and Liu 2008).
#pragma once

#include <optional>
#include <vector>

#include "lib/core/types.h"

namespace orthodyn {

class Curve {
 public:
  // At least two points, no two neighbours at the same place. `start_normal` (of which the part normal to
  // the curve counts) is not along the curve's start; without it any_normal() is taken.
  explicit Curve(const std::vector<Vec3>& points, const std::optional<Vec3>& start_normal = {});

  struct Foot {
    Vec3 point;
    Vec3 tangent;  // unit, towards the end
    Vec3 normal;   // unit, the one that was carried along
  };

  // The point of the curve nearest to x; beyond the ends it is the end.
  Foot nearest(const Vec3& x) const;

  // The direction of the curve at its first point, unit.
  Vec3 start_tangent() const { return derivative(0).normalized(); }
  double length() const { return length_; }

 private:
  // Piece i over [i, i + 1]: c0 + c1 u + c2 u^2 + c3 u^3, u = s - i.
  struct Piece {
    Vec3 c[4];
    Vec3 center;  // of a ball that holds the piece
    double radius;
  };
  struct Start {
    double s, distance;
  };

  const Piece& piece(double s, double& u) const;
  Vec3 at(double s) const;
  Vec3 derivative(double s) const;
  double refined(const Vec3& x, const Start& start) const;
  Start nearest_chord(const Vec3& x) const;
  void carry(Vec3 normal);

  std::vector<Piece> pieces_;
  std::vector<Vec3> samples_, normals_;  // kChords per piece, and the end
  double length_ = 0;
};

}  // namespace orthodyn
