#include "lib/fem/terms/volume_projection.h"

#include <Eigen/QR>

namespace orthodyn {

Eigen::MatrixXd orthonormal_polynomials(int terms, const Eigen::Matrix3Xd& places, const Vector& V) {
  const Vector root = V.cwiseSqrt();
  Eigen::MatrixXd weighted(V.size(), terms);
  weighted.col(0) = root;
  if (terms == 4) {
    const Vec3 centre = places * V / V.sum();
    weighted.rightCols<3>() = root.asDiagonal() * (places.colwise() - centre).transpose();
  }
  const Eigen::MatrixXd orthonormal =
      weighted.householderQr().householderQ() * Eigen::MatrixXd::Identity(V.size(), terms);
  return root.cwiseInverse().asDiagonal() * orthonormal;
}

}  // namespace orthodyn
