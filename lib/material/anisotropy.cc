#include "lib/material/anisotropy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "lib/core/symmetric_eigen.h"
#include "lib/material/orthotropy.h"

namespace orthodyn {

namespace {

const double kRootOfTwo = std::sqrt(2.0);

double smallest_unit_diagonal_eigenvalue(const Mat6& C) {
  const Vec6 scale = C.diagonal().cwiseSqrt().cwiseInverse();
  const Mat6 unit = scale.asDiagonal() * C * scale.asDiagonal();
  return symmetric_eigenvalues(unit)[0];
}

}  // namespace

Mat6 mandel(const Mat6& C) {
  Vec6 scale = Vec6::Ones();
  scale.tail<3>().setConstant(kRootOfTwo);
  return scale.asDiagonal() * C * scale.asDiagonal();
}

bool is_stable(const AnisotropicStiffness& C) {
  return C.c.diagonal().minCoeff() > 0 && smallest_unit_diagonal_eigenvalue(C.c) >= kSmallestRhoEigenvalue;
}

double stabilising_factor(const AnisotropicStiffness& C, double margin) {
  const double lambda = smallest_unit_diagonal_eigenvalue(C.c);
  return lambda >= margin ? 1.0 : (1 - margin) / (1 - lambda);
}

AnisotropicStiffness shrink_couplings(const AnisotropicStiffness& C, double factor) {
  AnisotropicStiffness out{factor * C.c};
  out.c.diagonal() = C.c.diagonal();
  return out;
}

std::string describe_softest_strain(const AnisotropicStiffness& C) {
  const auto pairs = symmetric_eigenpairs(mandel(C.c));
  Vec6 e = pairs.vectors.col(0);
  e.tail<3>() /= kRootOfTwo;
  int largest = 0;
  e.cwiseAbs().maxCoeff(&largest);
  if (e[largest] < 0) e = -e;
  const char* const names[] = {"e11", "e22", "e33", "e12", "e23", "e13"};
  std::vector<std::string> parts;
  for (int i = 0; i < 6; ++i)
    if (std::abs(e[i]) > 0.005) parts.push_back(fmt::format("{}={:.2f}", names[i], e[i]));
  return fmt::format("smallest eigenvalue {:.3g} Pa, of the strain {}", pairs.values[0], fmt::join(parts, ", "));
}

}  // namespace orthodyn
