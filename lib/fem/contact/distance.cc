#include "lib/fem/contact/distance.h"

#include <Eigen/LU>
#include <vector>

namespace orthodyn {

namespace {

Distance with_length(const Eigen::Matrix<double, 3, 4>& z, const Eigen::Vector4d& share) {
  const Vec3 y = z * share;
  const double r = y.norm();
  return {y / r, r, share, z};
}

}  // namespace

Distance distance_of(const Vec3& x, const Triangle& triangle, const Vec3& L, bool on_plane) {
  Distance out = with_length((Eigen::Matrix<double, 3, 4>() << x, triangle).finished(), {1, -L[0], -L[1], -L[2]});
  std::vector<int> corners;  // of the triangle, the edge or the corner
  for (int k = 0; k < 3; ++k)
    if (on_plane || L[k] > 0) corners.push_back(1 + k);
  out.moves.setZero(4, static_cast<Eigen::Index>(corners.size()) - 1);
  for (Eigen::Index k = 0; k < out.moves.cols(); ++k) {
    out.moves(corners[0], k) = 1;
    out.moves(corners[static_cast<std::size_t>(k) + 1], k) = -1;
  }
  return out;
}

Distance distance_of(const Segment& first, const Segment& second, const NearestPlaces& places) {
  const auto [s, t] = places;
  Distance out = with_length((Eigen::Matrix<double, 3, 4>() << first, second).finished(), {1 - s, s, t - 1, -t});
  const bool first_moves = s > 0 && s<1, second_moves = t> 0 && t < 1;
  out.moves.setZero(4, Eigen::Index{first_moves} + Eigen::Index{second_moves});
  if (first_moves) out.moves.col(0) << -1, 1, 0, 0;
  if (second_moves) out.moves.rightCols<1>() << 0, 0, 1, -1;
  return out;
}

Vec12 Distance::gradient() const {
  Vec12 out;
  for (int k = 0; k < 4; ++k) out.segment<3>(3 * k) = share[k] * n;
  return out;
}

Mat12 Distance::second_derivative() const {
  Eigen::Matrix<double, 3, 12> B;
  for (int k = 0; k < 4; ++k) B.block<3, 3>(0, 3 * k) = share[k] * Mat3::Identity();
  Mat12 out = B.transpose() * B;
  if (moves.cols() > 0) {
    const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 2> dy = z * moves;
    Eigen::Matrix<double, 12, Eigen::Dynamic, 0, 12, 2> mixed = B.transpose() * dy;
    for (int k = 0; k < 4; ++k) mixed.middleRows<3>(3 * k) += r * n * moves.row(k);
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2> free = dy.transpose() * dy;
    out -= mixed * free.inverse() * mixed.transpose();
  }
  const Vec12 slope = gradient();
  return out - slope * slope.transpose();
}

}  // namespace orthodyn
