#include "tests/material/constants.h"

#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

OrthotropicConstants with_scaled_ratios(const Vec3& young, const Vec3& r) {
  OrthotropicConstants c;
  c.young = young;
  c.nu12 = r[0] * std::sqrt(young[0] / young[1]);
  c.nu23 = r[1] * std::sqrt(young[1] / young[2]);
  c.nu13 = r[2] * std::sqrt(young[0] / young[2]);
  return c;
}

OrthotropicConstants stable_family(const Vec3& young, double nu) {
  OrthotropicConstants c = with_scaled_ratios(young, Vec3::Constant(nu));
  const double scale = 1 / (2 * (1 + nu));
  c.g12 = scale * std::sqrt(young[0] * young[1]);
  c.g23 = scale * std::sqrt(young[1] * young[2]);
  c.g13 = scale * std::sqrt(young[0] * young[2]);
  return c;
}

OrthotropicConstants spruce() {
  OrthotropicConstants c;
  c.young = {10.8, 0.84, 0.46};
  c.nu12 = c.nu23 = 0.44;
  c.nu13 = 0.0225 * c.young[0] / c.young[2];
  c.g12 = 0.69, c.g23 = 0.032, c.g13 = 0.66;
  return c;
}

Mat3 rho_matrix(const Vec3& r) { return (Mat3() << 1, -r[0], -r[2], -r[0], 1, -r[1], -r[2], -r[1], 1).finished(); }

OrthotropicConstants random_stable(Random& random, double margin) {
  const auto modulus = [&] { return std::pow(10, random.between(-2, 2)); };
  for (;;) {
    const Vec3 r = random.vector();
    if (symmetric_eigenvalues(rho_matrix(r))[0] < margin) continue;
    OrthotropicConstants c = with_scaled_ratios({modulus(), modulus(), modulus()}, r);
    c.g12 = modulus(), c.g23 = modulus(), c.g13 = modulus();
    return c;
  }
}

double component(const Mat6& C, int i, int j, int k, int l) {
  constexpr int voigt_index[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  return C(voigt_index[i][j], voigt_index[k][l]);
}

}  // namespace orthodyn
