#include "lib/material/material.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

std::string why_inadmissible(const Material& material) {
  constexpr double kRoundOff = 1e-9;
  if (const double rho = material.density(); !(rho > 0 && std::isfinite(rho)))
    return fmt::format("its density is {:.6g} kg/m^3; it must be positive and finite", rho);
  const Mat6 C = voigt(material.stiffness());
  if (!C.allFinite()) return "its stiffness has entries that are not finite";
  if ((C - C.transpose()).cwiseAbs().maxCoeff() > kRoundOff * C.cwiseAbs().maxCoeff())
    return "its stiffness is not symmetric";
  // C is tested after scaling to a unit diagonal, as moduli may differ by decades.
  if (!(C.diagonal().minCoeff() > 0))
    return fmt::format("its stiffness is not positive definite: the smallest entry of its diagonal is {:.4g} Pa",
                       C.diagonal().minCoeff());
  const Vec6 scale = C.diagonal().cwiseSqrt().cwiseInverse();
  const Mat6 unit = scale.asDiagonal() * C * scale.asDiagonal();
  if (const double smallest = symmetric_eigenvalues(unit).minCoeff(); !(smallest > 0))
    return fmt::format("its stiffness is not positive definite: the smallest eigenvalue is {:.4g} Pa",
                       symmetric_eigenvalues(C).minCoeff());
  return why_inadmissible(material.viscoelasticity(), material.stiffness());
}

}  // namespace orthodyn
