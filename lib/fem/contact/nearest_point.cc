#include "lib/fem/contact/nearest_point.h"

#include <Eigen/LU>
#include <algorithm>

namespace orthodyn {

// Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.5.
Vec3 nearest_point(const Vec3& x, const Triangle& triangle) {
  const Vec3 a = triangle.col(0), b = triangle.col(1), c = triangle.col(2);
  const Vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

Vec3 foot_on_plane(const Vec3& x, const Triangle& triangle) {
  Eigen::Matrix<double, 3, 2> E;
  E << triangle.col(1) - triangle.col(0), triangle.col(2) - triangle.col(0);
  const Eigen::Vector2d m = (E.transpose() * E).inverse() * (E.transpose() * (x - triangle.col(0)));
  return {1 - m[0] - m[1], m[0], m[1]};
}

// Source: Ericson (2005), section 5.1.9.
NearestPlaces nearest_places(const Segment& first, const Segment& second) {
  const auto bounded = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const Vec3 d1 = first.col(1) - first.col(0), d2 = second.col(1) - second.col(0), y = first.col(0) - second.col(0);
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), b = d1.dot(d2), c = d1.dot(y), f = d2.dot(y);
  const double determinant = a * e - b * b;
  double s = determinant > 0 ? bounded((b * f - c * e) / determinant) : 0;
  double t = (b * s + f) / e;
  if (t < 0) {
    t = 0;
    s = bounded(-c / a);
  } else if (t > 1) {
    t = 1;
    s = bounded((b - c) / a);
  }
  return {s, t};
}

bool pierces(const Segment& segment, const Triangle& triangle) {
  const Vec3 a = triangle.col(0), normal = (triangle.col(1) - a).cross(triangle.col(2) - a);
  const double from = normal.dot(segment.col(0) - a), to = normal.dot(segment.col(1) - a);
  if (!((from < 0 && to > 0) || (from > 0 && to < 0))) return false;
  const Vec3 x = segment.col(0) + from / (from - to) * (segment.col(1) - segment.col(0));
  for (int k = 0; k < 3; ++k) {
    const Vec3 corner = triangle.col(k), side = triangle.col((k + 1) % 3) - triangle.col(k);
    if (!(side.cross(x - corner).dot(normal) >= 0)) return false;
  }
  return true;
}

}  // namespace orthodyn
