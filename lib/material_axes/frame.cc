#include "lib/material_axes/frame.h"

namespace orthodyn {

Mat3 frame(const Vec3& first, const Vec3& second) {
  Mat3 Q;
  Q.col(0) = first.stableNormalized();
  Q.col(1) = second.stableNormalized();
  for (int twice = 0; twice < 2; ++twice)  // the second pass is for nearly parallel directions
    Q.col(1) = (Q.col(1) - Q.col(0).dot(Q.col(1)) * Q.col(0)).normalized();
  Q.col(2) = Q.col(0).cross(Q.col(1));
  return Q;
}

bool are_independent(const Vec3& first, const Vec3& second) {
  return first.stableNormalized().cross(second.stableNormalized()).norm() > 1e-6;
}

Vec3 any_normal(const Vec3& direction) {
  Eigen::Index least = 0;
  direction.cwiseAbs().minCoeff(&least);
  return frame(direction, Vec3::Unit(least)).col(1);
}

Mat3 in_order(const Mat3& directions, const std::string& letters, const std::string& word) {
  Mat3 Q;
  for (std::size_t i = 0; i < 2; ++i)
    Q.col(static_cast<Eigen::Index>(i)) = directions.col(static_cast<Eigen::Index>(letters.find(word[i])));
  Q.col(2) = Q.col(0).cross(Q.col(1));
  return Q;
}

}  // namespace orthodyn
