#include "lib/fem/contact/nearest_point.h"

#include <Eigen/LU>
#include <vector>

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

Vec12 Distance::gradient() const {
  Vec12 out;
  out << n, -L[0] * n, -L[1] * n, -L[2] * n;
  return out;
}

Mat12 Distance::second_derivative() const {
  Eigen::Matrix<double, 3, 12> B;
  B << Mat3::Identity(), -L[0] * Mat3::Identity(), -L[1] * Mat3::Identity(), -L[2] * Mat3::Identity();
  std::vector<int> corners;  // of the triangle, the edge or the corner that p lies in
  for (int k = 0; k < 3; ++k)
    if (on_plane || L[k] > 0) corners.push_back(k);
  Mat12 out = B.transpose() * B;
  const auto m = static_cast<Eigen::Index>(corners.size()) - 1;
  if (m > 0) {
    Eigen::MatrixXd E(3, m), coupling(12, m);
    for (Eigen::Index k = 0; k < m; ++k) {
      const int first = corners[0], other = corners[static_cast<std::size_t>(k) + 1];
      E.col(k) = triangle.col(other) - triangle.col(first);
      coupling.col(k) = -B.transpose() * E.col(k);
      coupling.block<3, 1>(3 + 3 * first, k) += r * n;
      coupling.block<3, 1>(3 + 3 * other, k) -= r * n;
    }
    out -= coupling * Eigen::MatrixXd(E.transpose() * E).inverse() * coupling.transpose();
  }
  const Vec12 slope = gradient();
  return out - slope * slope.transpose();
}

}  // namespace orthodyn
