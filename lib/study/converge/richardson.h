// The limit of values on meshes that are refined by one ratio, from the last of them (Richardson; Roache 1998,
// Verification and Validation in Computational Science and Engineering, ch. 5).
#pragma once

#include <optional>
#include <vector>

namespace orthodyn::study::converge {

struct Extrapolation {
  double limit = 0;
  double uncertainty = 0;       // of the limit, absolute: 1.25 or 3 times its distance from the finest value
  std::optional<double> order;  // observed on the last three values, where they approach a limit
};

// `values` from coarse to fine, each mesh `ratio` times as fine as the one before. The observed order is taken from 1/2
// to `highest`; where there is none, 1, with the larger uncertainty. None for fewer than two values.
std::optional<Extrapolation> extrapolate(const std::vector<double>& values, double ratio, double highest);

}  // namespace orthodyn::study::converge
