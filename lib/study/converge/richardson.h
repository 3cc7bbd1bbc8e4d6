// Richardson extrapolation of values on successively refined meshes (Roache 1998, Verification and Validation in
// Computational Science and Engineering, ch. 5).
#pragma once

#include <optional>
#include <vector>

namespace orthodyn::study::converge {

struct Extrapolation {
  double limit = 0;
  double uncertainty = 0;       // absolute: 1.25 |limit - finest value|, or the range of the last three values
  std::optional<double> order;  // observed on the last three values; empty if they are equal or oscillate
};

// Extrapolates the last three of `values`, which are ordered from coarse to fine; each mesh is `ratio` times finer than
// the one before. An observed order above `highest` is replaced by `highest` for the limit. If they oscillate within 5
// %, the limit is the finest value, and the uncertainty is their range. Empty for fewer than three values and for
// values that may have no limit: differences that do not decrease, wider oscillations, or an observed order below 1/2.
std::optional<Extrapolation> extrapolate(const std::vector<double>& values, double ratio, double highest);

}  // namespace orthodyn::study::converge
