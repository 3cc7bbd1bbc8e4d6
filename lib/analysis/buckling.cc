#include "lib/analysis/buckling.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/analysis/modes.h"
#include "lib/analysis/prebuckling.h"
#include "lib/linear/negative_eigenpairs.h"

namespace orthodyn {

namespace {

constexpr double kLargestStrain = 0.1;  // strain at the load-factor limit

// The largest small-strain norm (Frobenius) of a displacement.
double largest_strain(const FemModel& model, double t, const Vector& u) {
  const NodalExpansion nodal(model.parts(), t, u, Vector::Zero(u.size()));
  double largest = 0;
  for (const auto& term : model.parts().elastic)
    for (int k = 0; k < term->size(); ++k)
      for (int p = 0; p < term->num_points(); ++p)
        largest = std::max(largest, term->small_strain(k, p, nodal.u).norm());
  return largest;
}

}  // namespace

BucklingModes buckling_modes(const FemModel& model, const Vector& unloaded, double t, int count) {
  const Pattern& pattern = model.pattern();
  const Prebuckling before(model, unloaded, t);
  const auto& [u, times] = before.response();
  const MatrixValues& K = before.stiffness();
  const MatrixValues rate = small_load_stiffness(model, t, unloaded, before.response());
  const double smallest = largest_strain(model, t, u) / kLargestStrain;
  // The eigenvalues are -times / lambda.
  const NegativeEigenPairs pairs = negative_eigenpairs(pattern, rate, K, smallest, count);
  BucklingModes out{{}, times / smallest};
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    BucklingMode mode{-times / pairs.values[k], pairs.shapes.col(k)};
    fix_sign(mode.shape);
    Vector stressed(u.size()), missing(u.size()), elastic(u.size());
    pattern.multiply(rate.data(), mode.shape, stressed);
    before.solver().solve(stressed, missing);
    missing = mode.shape + mode.load_factor / times * missing;
    pattern.multiply(K.data(), missing, elastic);
    mode.residual = std::sqrt(std::max(missing.dot(elastic), 0.0));
    out.modes.push_back(std::move(mode));
  }
  return out;
}

}  // namespace orthodyn
