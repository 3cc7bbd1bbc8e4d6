// Richardson extrapolation of values on successively refined meshes (Roache 1998, Verification and Validation in
// Computational Science and Engineering, ch. 5).
#pragma once

#include <optional>
#include <vector>

namespace orthodyn::study::converge {

struct Extrapolation {
  double limit = 0;
  double uncertainty = 0;       // absolute: 1.25 |limit - finest value|; the range of the last three if they are equal
  std::optional<double> order;  // observed on the last three values; empty if they are equal
};

// Extrapolates the last three of `values`, which are ordered from coarse to fine; each mesh is `ratio` times finer than
// the one before. An observed order above `highest` is replaced by `highest` for the limit. Empty for fewer than three
// values and for values that may have no limit: differences that do not decrease or that change sign, or an observed
// order below 1/2.
std::optional<Extrapolation> extrapolate(const std::vector<double>& values, double ratio, double highest);

}  // namespace orthodyn::study::converge
