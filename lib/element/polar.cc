#include "lib/element/polar.h"

#include <cmath>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

using Mat4 = Eigen::Matrix4d;
using Vec4 = Eigen::Vector4d;

constexpr double kRotationTolerance = 1e-15;  // on |a(R^T F)| / |F|, aimed at
constexpr double kAcceptTolerance = 1e-13;    // and accepted
constexpr double kSingularG = 1e-9;           // det G / |F|^3 below which R is not unique to round-off

Mat4 davenport(const Mat3& F) {
  const Vec3 z = axial<double>(F);
  Mat4 B;
  B(0, 0) = F.trace();
  B.block<1, 3>(0, 1) = z.transpose();
  B.block<3, 1>(1, 0) = z;
  B.bottomRightCorner<3, 3>() = F + F.transpose() - F.trace() * Mat3::Identity();
  return B;
}

// Unit quaternion (w, x, y, z) to rotation.
Mat3 rotation(const Vec4& q) { return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(); }

// Largest root of lambda^4 - 2 lambda^2 - 8 d lambda + c, for |F| = 1: tr(S).
double largest_eigenvalue(const Mat3& F) {
  const double d = F.determinant();
  Mat3 cof;
  cof.col(0) = F.col(1).cross(F.col(2));
  cof.col(1) = F.col(2).cross(F.col(0));
  cof.col(2) = F.col(0).cross(F.col(1));
  const double c = 1 - 4 * cof.squaredNorm();
  double x = 1.7320508075688772;  // tr(S) <= sqrt(3) |F|
  for (int i = 0; i < 8; ++i) {
    const double x2 = x * x;
    const double slope = 4 * x * (x2 - 1) - 8 * d;
    if (!(slope > 1e-9)) break;
    const double dx = ((x2 - 2) * x2 - 8 * d * x + c) / slope;
    x -= dx;
    if (std::abs(dx) < 1e-6) break;  // the polishing steps square the error, twice
  }
  return x;
}

// The column with the largest diagonal entry of the adjugate of a symmetric 4x4 matrix: for a
// singular one, its null vector.
Vec4 adjugate_column(const Mat4& m) {
  const double s0 = m(0, 0) * m(1, 1) - m(1, 0) * m(0, 1), s1 = m(0, 0) * m(1, 2) - m(1, 0) * m(0, 2);
  const double s2 = m(0, 0) * m(1, 3) - m(1, 0) * m(0, 3), s3 = m(0, 1) * m(1, 2) - m(1, 1) * m(0, 2);
  const double s4 = m(0, 1) * m(1, 3) - m(1, 1) * m(0, 3);
  const double c5 = m(2, 2) * m(3, 3) - m(3, 2) * m(2, 3), c4 = m(2, 1) * m(3, 3) - m(3, 1) * m(2, 3);
  const double c3 = m(2, 1) * m(3, 2) - m(3, 1) * m(2, 2), c2 = m(2, 0) * m(3, 3) - m(3, 0) * m(2, 3);
  const double c1 = m(2, 0) * m(3, 2) - m(3, 0) * m(2, 2), c0 = m(2, 0) * m(3, 1) - m(3, 0) * m(2, 1);
  Mat4 A;
  A(0, 0) = m(1, 1) * c5 - m(1, 2) * c4 + m(1, 3) * c3;
  A(1, 0) = -m(1, 0) * c5 + m(1, 2) * c2 - m(1, 3) * c1;
  A(2, 0) = m(1, 0) * c4 - m(1, 1) * c2 + m(1, 3) * c0;
  A(3, 0) = -m(1, 0) * c3 + m(1, 1) * c1 - m(1, 2) * c0;
  A(1, 1) = m(0, 0) * c5 - m(0, 2) * c2 + m(0, 3) * c1;
  A(2, 1) = -m(0, 0) * c4 + m(0, 1) * c2 - m(0, 3) * c0;
  A(3, 1) = m(0, 0) * c3 - m(0, 1) * c1 + m(0, 2) * c0;
  A(2, 2) = m(3, 0) * s4 - m(3, 1) * s2 + m(3, 3) * s0;
  A(3, 2) = -m(3, 0) * s3 + m(3, 1) * s1 - m(3, 2) * s0;
  A(3, 3) = m(2, 0) * s3 - m(2, 1) * s1 + m(2, 2) * s0;
  A(0, 1) = A(1, 0), A(0, 2) = A(2, 0), A(0, 3) = A(3, 0);
  A(1, 2) = A(2, 1), A(1, 3) = A(3, 1), A(2, 3) = A(3, 2);
  int k = 0;
  A.diagonal().cwiseAbs().maxCoeff(&k);
  return A.col(k);
}

template <class T>
void set_stretch(const Mat3T<T>& A, Polar<T>& p) {
  p.S = symmetric_part(A);
  const Mat3T<T> G = p.S.trace() * Mat3T<T>::Identity() - p.S;
  const Mat3T<T> cof = cofactor_of_symmetric(G);
  p.det_G = G(0, 0) * cof(0, 0) + G(0, 1) * cof(0, 1) + G(0, 2) * cof(0, 2);
  p.G_inverse = cof / p.det_G;
}

// R <- R cay(w), the Cayley transform of the rotation vector w; exact to third order.
template <class T>
void turn(Mat3T<T>& R, const Vec3T<T>& w) {
  const Vec3T<T> h = T(0.5) * w;
  const T factor = T(2) / (T(1) + h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
  const Mat3T<T> H = cross_matrix(h);
  R += factor * (R * (H + H * H)).eval();
}

bool positive_definite(const Mat3& G, double det) {
  return G(0, 0) > 0 && G(0, 0) * G(1, 1) - G(0, 1) * G(0, 1) > 0 && det > kSingularG;
}

// Newton steps from p.R; true if p then holds the maximiser, to round-off. |F| = 1.
bool polish(const Mat3& F, int max_steps, Polar<double>& p) {
  for (int i = 0;; ++i) {
    const Mat3 A = p.R.transpose() * F;
    const Vec3 a = axial<double>(A);
    set_stretch<double>(A, p);
    const Mat3 G = p.S.trace() * Mat3::Identity() - p.S;
    if (!positive_definite(G, p.det_G)) return false;
    const double residual = a.norm();
    if (residual <= kRotationTolerance) return true;
    if (i == max_steps) return residual <= kAcceptTolerance;
    turn<double>(p.R, p.G_inverse * a);
  }
}

// The eigenvector of the largest eigenvalue; where that is multiple, the one nearest to identity.
Vec4 top_quaternion(const Mat3& F) {
  const Eigen::SelfAdjointEigenSolver<Mat4> eigen(davenport(F));
  const auto& values = eigen.eigenvalues();
  const auto& vectors = eigen.eigenvectors();
  Vec4 q = Vec4::Zero();
  for (int k = 3; k >= 0; --k)
    if (values[3] - values[k] < 1e-8) q += vectors(0, k) * vectors.col(k);
  return q.norm() > 1e-6 ? q.normalized() : vectors.col(3).eval();
}

void scale(Polar<double>& p, double factor) {
  p.S *= factor;
  p.G_inverse /= factor;
  p.det_G *= factor * factor * factor;
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
  const Vec4 q = adjugate_column(davenport(unit) - largest_eigenvalue(unit) * Mat4::Identity());
  if (const double length = q.norm(); length > 1e-12) {
    p.R = rotation(q / length);
    if (polish(unit, 3, p)) {
      scale(p, norm);
      return p;
    }
  }
  // The rotation relative to `tie`, so that a tie is broken in space and not in F's own columns.
  p.R = rotation(top_quaternion(unit * tie.transpose())) * tie;
  if (const Mat3 start = p.R; !polish(unit, 3, p)) {
    p.R = start;
    set_stretch<double>(start.transpose() * unit, p);
    if (!(p.det_G > 0)) p.det_G = 0, p.G_inverse.setZero();
  }
  scale(p, norm);
  return p;
}

Polar<std::complex<double>> polar(const Mat3T<std::complex<double>>& F, const Mat3& tie) {
  using C = std::complex<double>;
  Polar<C> p;
  p.R = polar(Mat3(F.real()), tie).R.cast<C>();
  for (int i = 0; i < 5; ++i) {
    const Mat3T<C> A = p.R.transpose() * F;
    set_stretch<C>(A, p);
    turn<C>(p.R, p.G_inverse * axial<C>(A));
  }
  set_stretch<C>(p.R.transpose() * F, p);
  return p;
}

}  // namespace orthodyn
