// The weight of a pair of edges in contact, which fades where they become parallel, and its derivatives by the
// positions z_1 z_2 and z_3 z_4 of their ends. Without it, the nearest points of parallel edges, and with them the
// force, would jump.
#pragma once

#include "lib/fem/contact/distance.h"

namespace orthodyn {

// How much a pair of edges counts, as a function of c, the square of the cross product of both, and its derivatives by
// c: 1 above c0, falling to 0 at 0.
struct EdgeWeight {
  double value = 1, slope = 0, curvature = 0;

  EdgeWeight() = default;
  EdgeWeight(double c, double c0) {
    if (c >= c0) return;
    value = c / c0 * (2 - c / c0);
    slope = 2 / c0 * (1 - c / c0);
    curvature = -2 / (c0 * c0);
  }
};

// The square of the cross product of two edges z_1 z_2 and z_3 z_4, with its derivatives by z.
struct CrossProduct {
  double square;
  Vec12 gradient;
  Mat12 curvature;

  explicit CrossProduct(const Eigen::Matrix<double, 3, 4>& z) {
    const Vec3 a = z.col(1) - z.col(0), b = z.col(3) - z.col(2);
    const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
    square = a.cross(b).squaredNorm();
    const Vec6 slope = 2 * (Vec6() << bb * a - ab * b, aa * b - ab * a).finished();
    Mat6 H;
    H.topLeftCorner<3, 3>() = bb * Mat3::Identity() - b * b.transpose();
    H.bottomRightCorner<3, 3>() = aa * Mat3::Identity() - a * a.transpose();
    H.topRightCorner<3, 3>() = 2 * a * b.transpose() - b * a.transpose() - ab * Mat3::Identity();
    H.bottomLeftCorner<3, 3>() = H.topRightCorner<3, 3>().transpose();
    Eigen::Matrix<double, 6, 12> edges = Eigen::Matrix<double, 6, 12>::Zero();  // (a, b) of z
    edges.block<3, 3>(0, 0) = edges.block<3, 3>(3, 6) = -Mat3::Identity();
    edges.block<3, 3>(0, 3) = edges.block<3, 3>(3, 9) = Mat3::Identity();
    gradient = edges.transpose() * slope;
    curvature = 2 * edges.transpose() * H * edges;
  }
};

}  // namespace orthodyn
