#include "lib/element/polar.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "lib/core/errors.h"
#include "lib/element/polar_steps.h"

namespace orthodyn {

using namespace polar_detail;

namespace {

// The eigenvector of Davenport's matrix for its largest eigenvalue. If that is multiple, the eigenvector nearest to the
// identity. If all are orthogonal to the identity (a point reflection), the one nearest to the first of the half turns
// about x, y and z to which not all are orthogonal.
Vec4T<double> top_quaternion(const Mat3& F) {
  const Eigen::SelfAdjointEigenSolver<Mat4T<double>> eigen(davenport<double>(F));
  const auto& values = eigen.eigenvalues();
  const auto& vectors = eigen.eigenvectors();
  for (int axis = 0; axis < 4; ++axis) {
    Vec4T<double> q = Vec4T<double>::Zero();
    for (int k = 3; k >= 0; --k)
      if (values[3] - values[k] < 1e-8) q += vectors(axis, k) * vectors.col(k);
    if (q.norm() > 1e-6) return q.normalized();
  }
  return vectors.col(3);  // not reached: the four axes span the space
}

// The polar decomposition of any F, for batches that are not near rotations.
[[gnu::noinline]] Batch::Mask general_polar(const Mat3T<Batch>& F, Polar<Batch>& p) {
  const Batch norm = sqrt(F.cwiseProduct(F).sum());
  const Mat3T<Batch> unit = F * (Batch(1) / norm);
  const Batch::Mask good = decompose_unit<Batch>(unit, p);
  scale<Batch>(p, norm);
  return good;
}

}  // namespace

Polar<double> polar(const Mat3& F, const Mat3& tie) {
  const double largest = F.cwiseAbs().maxCoeff();
  if (!std::isfinite(F.sum()) || !std::isfinite(largest))
    throw RecoverableError("a deformation gradient is not finite");
  Polar<double> p;
  if (largest == 0) {
    p.R = tie;
    p.S = p.G_inverse = Mat3::Zero();
    p.det_G = 0;
    return p;
  }
  const double norm = largest * (F / largest).norm();
  const Mat3 unit = F / norm;
  if (decompose_unit<double>(unit, p)) {
    scale<double>(p, norm);
    return p;
  }
  // Decomposes F relative to `tie`, so that ties are resolved in space and not in the columns of F.
  p.R = rotation<double>(top_quaternion(unit * tie.transpose())) * tie;
  if (const Mat3 start = p.R; !polish<double>(unit, p)) {
    p.R = start;
    set_stretch<double>(start.transpose() * unit, p);
    if (!(p.det_G > 0)) p.det_G = 0, p.G_inverse.setZero();
  }
  scale<double>(p, norm);
  return p;
}

Polar<std::complex<double>> polar(const Mat3T<std::complex<double>>& F, const Mat3& tie) {
  using C = std::complex<double>;
  Polar<C> p;
  p.R = polar(Mat3(F.real()), tie).R.cast<C>();
  for (int i = 0; i < 5; ++i) {
    const Mat3T<C> A = p.R.transpose() * F;
    set_stretch<C>(A, p);
    turn<C>(p.R, Vec3T<C>(p.G_inverse * axial<C>(A)));
  }
  set_stretch<C>(p.R.transpose() * F, p);
  return p;
}

ORTHODYN_FLATTEN Batch::Mask polar(const Mat3T<Batch>& F, Polar<Batch>& p) {
  if (Batch::Mask good; decompose_near_rotation<Batch>(F, p, good)) return good;
  return general_polar(F, p);
}

}  // namespace orthodyn
