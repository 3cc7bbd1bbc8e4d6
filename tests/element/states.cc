#include "tests/element/states.h"

#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

Deformation random_state(Random& random, const Vec3& stretches) {
  return {random.rotation(), random.rotation(), stretches};
}

Deformation random_strain(Random& random, double strain) {
  return random_state(random, Vec3::Ones() + strain * random.vector());
}

OrthotropicStiffness fibre(double ratio) { return stiffness(stable_family({ratio, 1, 1}, 0.3)); }

AnisotropicStiffness turned(const OrthotropicStiffness& C, const Mat3& A) {
  const Mat6 K = stress_rotation(A);
  return {K * voigt(C) * K.transpose()};
}

Mat3 unit_matrix(int k) {
  Mat3 E = Mat3::Zero();
  E(k % 3, k / 3) = 1;
  return E;
}

double asymmetry(const Mat9& H) { return (H - H.transpose()).norm() / H.norm(); }

double smallest_eigenvalue(const Mat9& H) {
  const auto lambda = symmetric_eigenvalues(Eigen::MatrixXd(H));
  return lambda[0] / lambda.cwiseAbs().maxCoeff();
}

double torque_fraction(const Mat3& P, const Mat3& F) {
  const Mat3 tau = P * F.transpose();
  return 0.5 * (tau - tau.transpose()).norm() / tau.norm();
}

}  // namespace orthodyn
