// A smooth curve through points in space, with nearest-point search and a rotation-minimising normal.
//
// Between two points the curve is a cubic with the derivatives of the centripetal Catmull-Rom spline, whose knot
// spacing is the square root of the distance. It has no cusps and no loops within a piece (Yuksel, Schaefer and Keyser
// 2011). The first and the last piece are parabolas; a curve through two points is straight. The tangent is continuous.
// The normal is transported without rotation about the tangent by double reflection (Wang, Juettler, Zheng and Liu
// 2008).
#pragma once

#include <optional>
#include <vector>

#include "lib/core/types.h"

namespace orthodyn {

class Curve {
 public:
  // At least two points (m), neighbours distinct. `start_normal` is projected normal to the curve and must not be
  // parallel to its start; default: any_normal().
  explicit Curve(const std::vector<Vec3>& points, const std::optional<Vec3>& start_normal = {});

  struct FootPoint {
    Vec3 point;
    Vec3 tangent;  // unit, towards the end
    Vec3 normal;   // unit, the transported normal
  };

  // The point of the curve nearest to x; an end point for x beyond the ends.
  FootPoint nearest(const Vec3& x) const;

  // Unit tangent at the first point.
  Vec3 start_tangent() const { return derivative(0).normalized(); }
  double length() const { return length_; }

 private:
  // Piece i, for the curve parameter s in [i, i + 1]: c0 + c1 u + c2 u^2 + c3 u^3 with u = s - i.
  struct Piece {
    Vec3 c[4];
    Vec3 center;  // of a ball that contains the piece
    double radius;
  };
  struct Guess {
    double s, distance;
  };

  const Piece& piece(double s, double& u) const;
  Vec3 at(double s) const;
  Vec3 derivative(double s) const;
  double refined(const Vec3& x, const Guess& start) const;
  Guess nearest_chord(const Vec3& x) const;
  void carry(Vec3 normal);

  std::vector<Piece> pieces_;
  std::vector<Vec3> samples_, normals_;  // at the ends of the kChords chords of each piece
  double length_ = 0;
};

}  // namespace orthodyn
